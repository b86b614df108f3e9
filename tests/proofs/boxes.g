#@ -Eprecision=256 -Eno-auto-dichotomy
# The boxes, src/spheres/hierarchy/boxes.rs, in f32: u = 2⁻²⁴. Lengths are divided by L, and t by L / d, where d is the
# component of the direction with which the box is tested, above zero. Each e is the error of one operation, at most u.
#
# By hand:
# - A hit at t is beyond the near plane: c ≤ p + t d, all as given. There |t d| ≤ 2 and |t D| ≤ 2, because the hit and the
#   origin are both within 1. Planes are rounded outwards, and that makes c only less.
# - The origin p1 is off by u where it is rounded and by u / 8 where it was moved, the component by u d, and where it was below
#   2 u D, by no more than 2 u D: so c ≤ p1 + t d1 + (1 + 1/8) u x + 2 u y + 4 u z, and t ≥ c - p1 less these, in L / d1.
# - What is computed for a far plane is this of the near one, with the signs turned around.
u = 1b-24;
unit = 1b-24 * (1 + 1b-20); # u, and a part of 2⁻²⁰ for the squares of errors

moved = u * (9 / 8 * x + 2 * y + 4 * z); # so t ≥ c - p1 - moved
r = 1 + r1;
by = (1 + n1) * (1 + f1); # the sums
entry = (c * r * (1 + c1) - p * r * (1 + p1) * (1 + n1)) * (1 + f1); # and less reach, times `by`

# How large a reach makes sure that the box is entered no later than at t: of the ray as given, and of a rounded and moved one.
reach = (entry - (c - p) + u * 4 * z) / (r * (1 + m1) * (1 + m2) * by * unit);
reach_of_rounded = (entry - (c - p) + moved) / (r * (1 + m1) * (1 + m2) * by * unit);

{ |r1| <= 1b-24 /\ |c1| <= 1b-24 /\ |p1| <= 1b-24 /\ |n1| <= 1b-24 /\ |f1| <= 1b-24 /\ |m1| <= 1b-24 /\ |m2| <= 1b-24
/\ |c| <= 1 /\ |p| <= 1 /\ |x| <= 1 /\ |y| <= 1 /\ |z| <= 1
->
   reach <= 11
/\ reach_of_rounded <= 14.125 # MARGIN, in u
}

entry - (c - p) -> c * (r * (1 + c1) * (1 + f1) - 1) - p * (r * (1 + p1) * (1 + n1) * (1 + f1) - 1);
