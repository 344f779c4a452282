"""Why friction depends on the size of pillars: four models of increasing content."""

SIZES = (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 30)  #: n_p, with gaps n_s as wide
