#@ -Eprecision=256 -Eno-auto-dichotomy
# The plain step, src/root/plain.rs. Lengths are divided by √m, where m is the larger of o·o and r², and directions by √a, so
# that m = a = 1. Each e is the error of one rounding, at most u = 2⁻⁵³.
#
# By hand:
# - A sum of terms of one sign, each times factors of 1 + e, is the sum times such factors: o·o, a and r² are written so.
# - Cauchy and Schwarz: the |oᵢ dᵢ| add up to at most |o| |d| ≤ 1. So h is H + C ((1 + e)⁴ - 1) with |C| ≤ 1. With H² ≤ o·o and
#   r² ≤ 1, power and discriminant are at most 1. The |oᵢ dⱼ| + |oⱼ dᵢ| together are a vector no longer than √2 |o| |d|.
# - Where a root is accepted, s (|h| + s) ≥ clear, |h| + s ≥ √clear, |power| ≥ clear, and s ≥ clear / 2: plain.rs derives it. It
#   is true of the computed numbers, but for 2⁻³⁰ of them: 40 u / clear is what h² - s² and power differ by, as a part of these.
# - √(D - x) = √D - x / (√D + √(D - x)). So with ρ = √(1 - x / D), what a discriminant's error x makes of √D is x / √D (1 + ρ).
u = 1b-53;
unit = 1b-53 * (1 + 1b-40); # u, and a part of 2⁻⁴⁰ for the squares of errors
sum = (1 + e1) * (1 + e2) * (1 + e3); # a product and two additions

power = oo - rr;
power1 = (oo * (1 + o1) * (1 + o1) * sum - rr * (1 + r1)) * (1 + p1);
power_error = (power1 - power) / unit;

dh = C * ((1 + o1) * sum - 1);
ap1 = (1 + a1) * (1 + a2) * (1 + a3) * power1 * (1 + q1);
discriminant = H * H - power;
discriminant_error = (((H + dh) * (H + dh) * (1 + h1) - ap1) * (1 + d1) - discriminant) / unit;

dM = sqrt(2) * ((1 + o1) * (1 + e1) - 1) * (1 + m1) + M * m1;
closest = rr - M * M;
rra1 = rr * (1 + r1) * (1 + a1) * (1 + a2) * (1 + a3) * (1 + q1);
closest_error = ((rra1 - (M + dM) * (M + dM) * sum) * (1 + d1) - closest) / unit;

# The root, power / (|h| + s), as computed over the exact one, less 1. With g for √clear / (|h| + s), k for clear / s (|h| + s),
# and x, y, z for the parts that the errors take of their bounds.
clear = 1b-16;
rho = sqrt(1 - 21 * unit * z / (clear * clear / 4.000001));
exact_sum = 1 - 4 * unit * y * g / 1b-8 - 21 * unit * z * k / (clear * (1 + rho));
root_error = (exact_sum * (1 + t1) / ((1 + s1) * (1 + s2) * (1 - 7 * unit * x / clear)) - 1) * (clear / u);

{ |o1| <= 1b-53 /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |r1| <= 1b-53 /\ |p1| <= 1b-53 /\ |a1| <= 1b-53
/\ |a2| <= 1b-53 /\ |a3| <= 1b-53 /\ |q1| <= 1b-53 /\ |h1| <= 1b-53 /\ |d1| <= 1b-53 /\ |m1| <= 1b-53 /\ |t1| <= 1b-53
/\ |s1| <= 1b-53 /\ |s2| <= 1b-53 /\ oo in [0, 1] /\ rr in [0, 1] /\ |power| <= 1 /\ |H| <= 1 /\ |C| <= 1 /\ |discriminant| <= 1
/\ M in [0, 1] /\ |closest| <= 1 /\ |x| <= 1 /\ |y| <= 1 /\ |z| <= 1 /\ g in [0, 1.000001] /\ k in [0, 1.000001]
->
   |power_error| <= 7 # POWER_ERROR, in u
/\ |discriminant_error| <= 21 # DISCRIMINANT_ERROR, in u
/\ |closest_error| <= 16.66
/\ |root_error| <= 17.52 # ROOT_ERROR, in u
}

power1 - power -> (oo * ((1 + o1) * (1 + o1) * sum - 1) - rr * r1) * (1 + p1) + power * p1;
((H + dh) * (H + dh) * (1 + h1) - ap1) * (1 + d1) - discriminant ->
    ((H * dh * 2 + dh * dh) * (1 + h1) + H * H * h1 - (power1 - power) * (1 + a1) * (1 + a2) * (1 + a3) * (1 + q1)
    - power * ((1 + a1) * (1 + a2) * (1 + a3) * (1 + q1) - 1)) * (1 + d1) + discriminant * d1;
(rra1 - (M + dM) * (M + dM) * sum) * (1 + d1) - closest ->
    (rr * ((1 + r1) * (1 + a1) * (1 + a2) * (1 + a3) * (1 + q1) - 1) - (M * dM * 2 + dM * dM) * sum
    - M * M * (sum - 1)) * (1 + d1) + closest * d1;
