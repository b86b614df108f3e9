#@ -Eprecision=256 -Eno-auto-dichotomy
# The bound of the case, src/root/bounded_chord.rs. Lengths are divided by |o| and directions by |d|, so that P = |o| |d| = 1. Each e
# is the error of one rounding, at most u = 2⁻⁵³. M is the length of o × d as computed.
#
# By hand:
# - The |oᵢ dⱼ| + |oⱼ dᵢ| together are a vector no longer than √2 |o| |d|. So o × d, of which each oᵢ is rounded, each product,
#   and the difference, errs by a vector of at most √2 ((1 + e)² - 1) P + |e| M. With C and E for the parts of these that the
#   error takes, |o × d| is M (1 + E) + √2 C ((1 + e)² - 1), and its square the sum of M² (1 + E)², 2 √2 M (1 + E) C ((1 + e)² -
#   1) and 2 C² ((1 + e)² - 1)².
# - So the error of the discriminant, computed less exact, is a sum of r² a A + M² B + M P F + P² G, as follows. Where |A|, |B|
#   and |F| are no more than K u, the first three are no more than K u (r² a + M² + M P).
u = 1b-53;
v = 1b-106; # u²
unit = 1b-53 * (1 + 1b-40); # u, and a part of 2⁻⁴⁰ for the squares of errors
sum = (1 + e1) * (1 + e2) * (1 + e3); # a product and two additions

A = (1 + r1) * (1 + a1) * (1 + a2) * (1 + a3) * (1 + q1) * (1 + d1) - 1;
B = (1 + E) * (1 + E) - sum * (1 + d1);
cross = sqrt(2) * C * ((1 + o1) * (1 + p1) - 1);
F = 2 * (1 + E) * cross;
G = cross * cross;

of_radius = A / unit;
of_moment = B / unit;
of_reach = F / unit;
squared = G / (u * unit);

{ |o1| <= 1b-53 /\ |p1| <= 1b-53 /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |r1| <= 1b-53 /\ |a1| <= 1b-53
/\ |a2| <= 1b-53 /\ |a3| <= 1b-53 /\ |q1| <= 1b-53 /\ |d1| <= 1b-53 /\ |E| <= 1b-53 /\ |C| <= 1
->
   |of_radius| <= 6 # DISCRIMINANT_ERROR, in u
/\ |of_moment| <= 6 # DISCRIMINANT_ERROR, in u
/\ |of_reach| <= 5.66 # DISCRIMINANT_ERROR, in u
/\ |squared| <= 8 # MOMENT_ERROR_SQUARED, in v
}
