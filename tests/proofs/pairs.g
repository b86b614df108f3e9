#@ -Eprecision=256 -Eno-auto-dichotomy
# A root of a moved origin, src/root/moved_origin.rs. Directions are divided by √a: so a = |d| = 1. Each e is the error of one
# rounding, at most u = 2⁻⁵³, and v = u².
#
# By hand:
# - w is exact but for two additions of low parts, which are rounded by v |w| and 4 u v (|t d| + |o|): pairs.rs. In the first
#   move, |w| ≤ r + 8 u √m and |t d| + |o| ≤ 2 √m. In the second, |w| ≤ 65/64 r, and |t d| + |o| is at most 3 r, because o is
#   then the w of the first, but for 8 u √m. Without a first move, it is at most 3 √m, which is less in all.
# - A power in pairs errs by 40 v |w|² (`surface`), and by 2 |w| times what w errs by. The slope w·d is at least 63/64 s, and τ
#   is half of the power over the slope.
# - Cauchy and Schwarz: the |wᵢ dᵢ| add up to at most |w|.
# - The bend a τ / s is at most 1/64. So y, which is a q over 2 w·d, is at most 0.0081.
# - (1 + y f) / (1 + y) is 1 + (f - 1) y / (1 + y).
# - All are sums of a multiple of r and of one of √m, with the coefficients below.
u = 1b-53;
v = 1b-106;
uv = 1b-159;
slack = 1 + 1b-40; # for the squares of errors

w_radius = v * (x1 + 65 / 64 * x2) + 12 * uv * x3;
w_reach = uv * (8 * x1 + 8 * x4) + 32 * u * uv * x3;
offset = w_radius / (v * slack);
offset_reach = w_reach / (uv * slack);
residual = (40 * v * 65 / 64 * 65 / 64 * x5 + 2 * 65 / 64 * w_radius) / 2 / (63 / 64) / (v * slack);
residual_reach = (2 * 65 / 64 * w_reach) / 2 / (63 / 64) / (uv * slack);

# The slope: w.hi for w, a product and two sums, in r |d| / s.
slope = 65 / 64 / (63 / 64) * x6 * ((1 + l1) * (1 + l2) * (1 + l3) * (1 + l4) - 1) / (u * slack);

# The operations, of q (1 + y) with y = a q / 2 w·d: the power as one number, the reciprocal, the product. In y, a 3, 3
# products, and the errors of the reciprocal and of q again. Then their sum, and 4 sums after that: w + τ d 2, its error 1, t +
# τ 1.
q = (1 + q1) * (1 + q2) * (1 + q3);
of_y = (1 + a1) * (1 + a2) * (1 + a3) * (1 + a4) * (1 + a5) * (1 + a6) * q * (1 + q2);
after = (1 + t1) * (1 + t2) * (1 + t3) * (1 + t4) * (1 + t5);
correction = (q * after - 1 + q * after * y / (1 + y) * (of_y - 1)) / (u * slack);

{ |x1| <= 1 /\ |x2| <= 1 /\ |x3| <= 1 /\ |x4| <= 1 /\ |x5| <= 1 /\ |x6| <= 1 /\ |l1| <= 1b-53 /\ |l2| <= 1b-53 /\ |l3| <= 1b-53
/\ |l4| <= 1b-53 /\ |q1| <= 1b-53 /\ |q2| <= 1b-53 /\ |q3| <= 1b-53 /\ |a1| <= 1b-53 /\ |a2| <= 1b-53 /\ |a3| <= 1b-53
/\ |a4| <= 1b-53 /\ |a5| <= 1b-53 /\ |a6| <= 1b-53 /\ |t1| <= 1b-53 /\ |t2| <= 1b-53 /\ |t3| <= 1b-53 /\ |t4| <= 1b-53
/\ |t5| <= 1b-53 /\ |y| <= 0.0081
->
   |offset| <= 2.016 # OFFSET_ERROR, in v
/\ |offset_reach| <= 16 # OFFSET_REACH_ERROR, in uv
/\ |residual| <= 23.05 # RESIDUAL_ERROR, in v
/\ |residual_reach| <= 16.51 # RESIDUAL_REACH_ERROR, in uv
/\ |slope| <= 4.13 # SLOPE_ERROR, in u
/\ |correction| <= 8.1 # CORRECTION_ERROR, in u
}
