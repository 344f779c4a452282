"""The error study: how far results can be trusted, measured and written down.

conventions       what tables, page, figures and claims agree on, and which residuals are suspect
reference         the solution that locates every event
plain_rk4         Runge-Kutta as one would first write it
work_precision    error against work, in two comparisons
production        bias, scatter and cost of the study's own ensembles
budget            what an ensemble misses for so much CPU time
consistency       whether the physics is the same where bits differ
stability         stiff and extreme cases
page              what to trust, in words
"""
