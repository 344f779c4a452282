"""Commands of the study: tables, pages, figures and the report."""
