#@ -Eprecision=256 -Eno-auto-dichotomy
# The early rejection, src/rejection.rs, in f32: u = 2⁻²⁴. In f64 the squares of errors are less. Each e is the error of one
# rounding, at most u. Lengths are divided by r, or by R = r + 3 u |c| where coordinates are rounded.
#
# By hand:
# - A sum of terms of one sign, each times factors of 1 + e, is the sum times such factors.
# - Cauchy and Schwarz: h errs by at most ((1 + e)⁴ - 1) |o| |d|. T is the largest value of s (2 h - s) / a for s from 0 to a
#   end: it changes by 2 m times what h changes by, and by at most 2 (h - s) m ≤ T times the part of itself that a end changes
#   by.
# - |o| |d| m ≤ T + ρ² / 2, where ρ is the distance from the center that the ray keeps where it hits: rejection.rs derives it.
# - A sphere of the numbers as given has ρ = r = 1, and o·o ≤ 1 + T if it is hit.
# - Of rounded coordinates, ρ = 1 + u + 2.25 u |o| at most, and 2 |o| ≤ 1 + o·o. So ρ² ≤ (1 + u)² + 2.25 u (1 + u) (1 + o·o) +
#   (2.25 u)² o·o, and o·o ≤ ρ² + T is o·o (1 - linear) ≤ constant + T with what stands below.
# - Such a sphere is not rejected where (o·o as computed) - (r² made larger) - (T made larger) is at most 0. All of it is a sum
#   of X r² + Y T, with the coefficients below; so X ≤ 0 and Y ≤ 0 are enough.
# - That is up to the closest approach. Beyond it, T falls with s: with s (1 + n) for s, and q and e as in rejection.rs, T changes
#   by at most 2 (1 + n) |o| q times what h errs by, 2 n q e and n² q²; and the difference h - s is at most e + n q and what h
#   errs by. There |o| q ≤ 2 ρ² + 1.5 T and q e ≤ 2 ρ² + T / 2, and so q² ≤ 4 ρ² + 2 T.
# - A negative T is |T| ≤ ρ² - o·o, and |o| q, q e and q² / 2 are at most 2 ρ².
u = 1b-24;
unit = 1b-24 * (1 + 1b-16); # u, and a part of 2⁻¹⁶ for the squares of errors

by3 = (1 + e1) * (1 + e2) * (1 + e3);
by6 = by3 * (1 + e4) * (1 + e5) * (1 + e6); # o twice, a product, 3 sums
radius3 = (1 + r1) * (1 + r2) * (1 + r3); # r² a product, its factor a product, a sum
# a 3, the quotient 1, 2 products, 2 sums
T8 = (1 + t1) * (1 + t2) * (1 + t3) * (1 + t4) * (1 + t5) * (1 + t6) * (1 + t7) * (1 + t8);
end4 = (1 + n1) * (1 + n2) * (1 + n3) * (1 + n4); # a 3, a product
T7 = (1 + t1) * (1 + t2) * (1 + t3) * (1 + t4) * (1 + t5) * (1 + t6) * (1 + t7); # with the second sum
n = (1 + n1) * (1 + n2) * (1 + n3) * (1 + n4) * (1 + n5) - 1; # of a start: a 3, a product, t was rounded
h_part = (1 + h1) * (1 + h2) * (1 + h3) * (1 + h4) - 1; # o, a product, 2 sums

# What r² and T have to be made larger by, of numbers as given. (36 u is the code's part of T.)
of_radius = ((by6 + h_part * (1 + 36 * u) * T8 * end4) / radius3 - 1) / unit;
of_T = (by6 / ((1 - 2 * h_part) * T8 * end4) - 1) / unit;

# And of rounded ones.
linear = 2.25 * u * (1 + u) + 2.25 * u * 2.25 * u;
at_center = ((1 + u) * (1 + u) + 2.25 * u * (1 + u)) / (1 - linear);
of_rounded_radius = ((at_center * by6 + h_part * at_center * (1 + 36 * u) * T8 * end4) / radius3 - 1) / unit;
of_rounded_T = ((by6 / (1 - linear)) / ((1 - 2 * h_part - h_part * linear / (1 - linear)) * T8 * end4) - 1) / unit;

# Beyond the closest approach: what T errs by, in ρ² and in T. Of r² a third: it is made larger by three times the margin.
in_radius = 4 * (1 + n) * h_part + 4 * n + 4 * n * n + t8 * (1 + n) * (2 + 2 * h_part + 4 * n);
in_T = 3 * (1 + n) * h_part + n + 2 * n * n + t8 * (1 + n) * (0.5 + 1.5 * h_part + 2 * n);
third_of_radius_beyond = (at_center * (by6 + (1 + 36 * u) * T7 * in_radius) / radius3 - 1) / 3 / unit;
of_T_beyond = (by6 / (1 - linear) / (T7 * (1 - in_T - in_radius * linear / (1 - linear))) - 1) / unit;
third_of_radius_inside = (at_center * ((1 + 36 * u) * T7 * (1 + in_radius)) / radius3 - 1) / 3 / unit;

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-24 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24 /\ |e6| <= 1b-24 /\ |r1| <= 1b-24
/\ |r2| <= 1b-24 /\ |r3| <= 1b-24 /\ |t1| <= 1b-24 /\ |t2| <= 1b-24 /\ |t3| <= 1b-24 /\ |t4| <= 1b-24 /\ |t5| <= 1b-24
/\ |t6| <= 1b-24 /\ |t7| <= 1b-24 /\ |t8| <= 1b-24 /\ |n1| <= 1b-24 /\ |n2| <= 1b-24 /\ |n3| <= 1b-24 /\ |n4| <= 1b-24
/\ |n5| <= 1b-24 /\ |h1| <= 1b-24 /\ |h2| <= 1b-24 /\ |h3| <= 1b-24 /\ |h4| <= 1b-24
->
   of_radius <= 13
/\ of_T <= 26
/\ of_rounded_radius <= 19.5
/\ of_rounded_T <= 28.25 # MARGIN, in u
/\ third_of_radius_beyond <= 17.84 # MARGIN, in u
/\ of_T_beyond <= 32.75 # MARGIN, in u
/\ third_of_radius_inside <= 30.17 # MARGIN, in u
}
