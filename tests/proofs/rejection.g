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
u = 1b-24;
unit = 1b-24 * (1 + 1b-16); # u, and a part of 2⁻¹⁶ for the squares of errors

by3 = (1 + e1) * (1 + e2) * (1 + e3);
by6 = by3 * (1 + e4) * (1 + e5) * (1 + e6); # o twice, a product, 3 sums
radius3 = (1 + r1) * (1 + r2) * (1 + r3); # r² a product, its factor a product, a sum
# a 3, the quotient 1, 2 products, 2 sums
T8 = (1 + t1) * (1 + t2) * (1 + t3) * (1 + t4) * (1 + t5) * (1 + t6) * (1 + t7) * (1 + t8);
end4 = (1 + n1) * (1 + n2) * (1 + n3) * (1 + n4); # a 3, a product
h_part = (1 + h1) * (1 + h2) * (1 + h3) * (1 + h4) - 1; # o, a product, 2 sums

# What r² and T have to be made larger by, of numbers as given. (48 u is the code's part of T.)
of_radius = ((by6 + h_part * (1 + 48 * u) * T8 * end4) / radius3 - 1) / unit;
of_T = (by6 / ((1 - 2 * h_part) * T8 * end4) - 1) / unit;

# And of rounded ones, for T half of it: it is made larger by twice the margin.
linear = 2.25 * u * (1 + u) + 2.25 * u * 2.25 * u;
at_center = ((1 + u) * (1 + u) + 2.25 * u * (1 + u)) / (1 - linear);
of_rounded_radius = ((at_center * by6 + h_part * at_center * (1 + 48 * u) * T8 * end4) / radius3 - 1) / unit;
half_of_rounded_T = ((by6 / (1 - linear)) / ((1 - 2 * h_part - h_part * linear / (1 - linear)) * T8 * end4) - 1) / 2 / unit;

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-24 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24 /\ |e6| <= 1b-24 /\ |r1| <= 1b-24
/\ |r2| <= 1b-24 /\ |r3| <= 1b-24 /\ |t1| <= 1b-24 /\ |t2| <= 1b-24 /\ |t3| <= 1b-24 /\ |t4| <= 1b-24 /\ |t5| <= 1b-24
/\ |t6| <= 1b-24 /\ |t7| <= 1b-24 /\ |t8| <= 1b-24 /\ |n1| <= 1b-24 /\ |n2| <= 1b-24 /\ |n3| <= 1b-24 /\ |n4| <= 1b-24
/\ |h1| <= 1b-24 /\ |h2| <= 1b-24 /\ |h3| <= 1b-24 /\ |h4| <= 1b-24
->
   of_radius <= 13
/\ of_T <= 26
/\ of_rounded_radius <= 19.5 # MARGIN, in u
/\ half_of_rounded_T <= 14.125 # MARGIN, in u
}
