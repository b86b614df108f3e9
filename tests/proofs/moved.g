#@ -Eprecision=256 -Eno-auto-dichotomy
# The closest approach of a moved origin, src/root/moved_origin.rs. Directions are divided by √a: so a = |d| = 1 and P = |o|. R is the
# larger of |w| and r. Each e is the error of one rounding, at most u = 2⁻⁵³, and v = u².
#
# By hand:
# - w is exact but for two additions of low parts. They are rounded by v |w| and 4 u v (|t d| + |o|), where |t d| ≤ |o|:
#   pairs.rs.
# - Cauchy and Schwarz: the |wᵢ dᵢ| add up to at most R. Of a compensated dot product 8 v R are off (`arithmetic::pair`), and
#   the plain one, and so its low part, by u for products and 2 u for sums. A low part of w is at most u |w|.
# - w·d is t a - h. There h errs by 4 u P, as in plain.g, and h / a by 4 u of it: w·d = P Z.
# - A power in pairs errs by 40 v R² (`surface`), and by 2 R times what w errs by.
# - The power is exactly P² Z² - D, where D is the discriminant. So the error of the discriminant is a sum of R² X, R P Y, P² Q
#   and D G, with the coefficients below.
u = 1b-53;
v = 1b-106;
uv = 1b-159;
slack = 1 + 1b-40; # for the squares of errors

w_radius = v * w1; # the error of w, in R and in P
w_reach = 8 * uv * w2;

# w·d: Z as computed is Z (1 + l3) + in_reach, and in_radius R / P.
Z = (4 * u * z1 + (((1 + a1) * (1 + a2) * (1 + a3)) * (1 + a4) - 1) * z2);
low = 3 * u * c1; # the low part of the compensated product, over R
lows = u * c2 * ((1 + l1) * (1 + l2) * (1 + l4)); # d·w.low
in_radius = (8 * v * c3 + (lows - u * c2) + (low + lows) * l5 + w_radius) * (1 + l3);
in_reach = w_reach * (1 + l3) + Z * l3;

# The square of that, and the power.
by = (1 + a1) * (1 + a2) * (1 + a3) * (1 + b1) * (1 + b2); # a, the power as one number, the product
power_radius = (40 * v * x1 + 2 * w_radius) * by;
power_reach = 2 * w_reach * by;
square_radius = in_radius * in_radius * (1 + s1);
square_mixed = 2 * (Z + in_reach) * in_radius * (1 + s1);
square_reach = (2 * Z * in_reach + in_reach * in_reach) * (1 + s1) + Z * Z * s1;

of_radius = (square_radius - power_radius) * (1 + d1) / (v * slack);
of_reach = (square_mixed - power_reach) * (1 + d1) / (uv * slack);
along = (square_reach - Z * Z * (by - 1)) * (1 + d1) / (uv * slack);
of_itself = (by * (1 + d1) - 1) / (u * slack);

{ |a1| <= 1b-53 /\ |a2| <= 1b-53 /\ |a3| <= 1b-53 /\ |a4| <= 1b-53 /\ |l1| <= 1b-53 /\ |l2| <= 1b-53 /\ |l3| <= 1b-53
/\ |l4| <= 1b-53 /\ |l5| <= 1b-53 /\ |b1| <= 1b-53 /\ |b2| <= 1b-53 /\ |s1| <= 1b-53 /\ |d1| <= 1b-53 /\ |w1| <= 1
/\ |w2| <= 1 /\ |z1| <= 1 /\ |z2| <= 1 /\ |c1| <= 1 /\ |c2| <= 1 /\ |c3| <= 1 /\ |x1| <= 1
->
   |of_radius| <= 42 # MOVED_ERROR, in v
/\ |of_reach| <= 272 # MOVED_REACH_ERROR, in uv
/\ |along| <= 512 # MOVED_ALONG_ERROR, in uv
/\ |of_itself| <= 6
}

lows - u * c2 -> u * c2 * ((1 + l1) * (1 + l2) * (1 + l4) - 1);
