"""The error study: errors of single runs and of ensembles, and the page on them.

conventions       constants that tables, page, figures and claims share; suspect residuals
reference         solution that locates every event
plain_rk4         Runge-Kutta method with the friction of each stage
work_precision    error against work, in two comparisons
production        bias, scatter and cost of ensembles of the study's size
budget            total error of an ensemble for a given CPU time
consistency       whether the physics is the same where bits differ
stability         stiff and extreme cases
page              the page on errors
"""
