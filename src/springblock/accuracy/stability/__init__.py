"""Stiff and extreme cases, which feed both the table `stability` and the tests.

Every case says what it expects, in a word, and measures what comes out. Most compare a number with
its closed form; how far it may be off follows from the order of the scheme, or from rounding:

- A release is placed within its step: exactly where the force rises evenly, as it does before the
  first one. A stop falls on the boundary of the step that holds it. What depends on stops, or on
  damping that is stiff within a step, may be wrong by what changes in one step.
- While a block slides one way, or has no friction, both schemes are linear at small strains, and
  their own solution is known exactly (`schemes`). What is left is the strain, and rounding.

Each of these also bounds what may be missing from the energy balance (`Pull.may_miss`).

Units in the code: forces in F_n, lengths in F_n/K_s, times in 1/omega with omega² = K_s/m, and so
speeds in F_n omega/K_s, unless they are said to be SI.
"""
