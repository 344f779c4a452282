"""The page that shows a study: findings, figures, films, pages and tables in one HTML file."""
