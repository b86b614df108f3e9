#@ -Eprecision=256 -Eno-auto-dichotomy
# The correction from halves, src/root/halves.rs. Lengths are divided by √m and directions by √a: so m = a = 1, 0 < r ≤ 1, |t| ≤
# 2. Each e is the error of one rounding, at most u = 2⁻⁵³.
#
# By hand, as halves.rs has it:
# - t.low is at most 2⁻²⁵ t, each coordinate of d.low, of o.low and of `rest` at most 2⁻²⁶, and all four are exact. A vector of
#   three such coordinates is no longer than √3 of it, and if each is rounded by a part of itself, so is the vector.
# - High parts and their products and sums are exact: what is rounded are w.low and the two products with low parts.
# - Where a root is accepted, |w| = r but for 2⁻¹⁶ of it, r / s |t| < 2¹⁰, |τ| < 18 · 2⁻³⁷ |t|, and s > 2⁻¹⁷.
# - Cauchy and Schwarz: the |wᵢ dᵢ| add up to at most |w|, and the |w.lowᵢ (w + w.high)ᵢ| to at most 2 |w.low| |w|.
# - What errors e, f of w and of the residual make of that: 2 |w| e + e² + f; and half of it over s of τ.
u = 1b-53;
slack = 1 + 1b-11; # for |w|, s and the squares of errors

# w.low of one coordinate, and of the vector: th, tl, dl, d, ol, rest and what is rounded.
step = dl * th;
low = d * tl;
w_low = (rest + ((step * (1 + e1) + low * (1 + e2)) * (1 + e3) - ol * (1 + e4)) * (1 + e5)) * (1 + e6);
w_error = (w_low - (rest + step + low - ol)) / (1b-74 * slack);
v_step = vdl * th;
v_low = vd * tl;
v_w_low = (vrest + ((v_step * (1 + e1) + v_low * (1 + e2)) * (1 + e3) - vol * (1 + e4)) * (1 + e5)) * (1 + e6);
v_error = v_w_low - (vrest + v_step + v_low - vol);

# The residual over r: 2 w w.low in w, w + w.high, a product, 2 sums and the difference; r.low (r.low + 2 r.high) in 3
# operations.
products = 2 * C * v_w_low * ((1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6) - 1);
square = 2 * rl * ((1 + e1) * (1 + e2) * (1 + e3) - 1);
residual_error = (2 * C * v_error + products - square) / 2 / (1b-72 * slack);

slope_error = C * ((1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) - 1) / (u * slack);

# The root, over t: the residual's, with r / s |t| = 2¹⁰ g; the slope's and of 10 operations, and the term of third order, of τ.
tau = 18 * 1b-37 * x;
bend = tau * 262144 * y;
of_tau = slope_error * u * 131072 + 10 * u * z + bend * bend / 2;
root_error = (residual_error * 1b-72 * 1024 * g + tau * of_tau) / 1b-62 / slack;

{ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\ |e6| <= 1b-53 /\ |th| <= 2 /\ |tl| <= 1b-24
/\ |d| <= 1 /\ |dl| <= 1b-26 /\ |ol| <= 1b-26 /\ |rest| <= 1b-26 /\ |vd| <= 1 /\ |vdl| <= 2.58096e-8 /\ |vol| <= 2.58096e-8
/\ |vrest| <= 2.58096e-8 /\ |rl| <= 1b-26 /\ |C| <= 1 /\ |g| <= 1 /\ |x| <= 1 /\ |y| <= 1 /\ |z| <= 1
->
   |w_error| <= 0.875 # OFFSET_ERROR, in 1b-74
/\ |residual_error| <= 0.823 # RESIDUAL_ERROR, in 1b-72
/\ |slope_error| <= 4 # SLOPE_ERROR, in u
/\ |root_error| <= 1.214 # ROOT_ERROR, in 1b-62
}

w_low - (rest + step + low - ol) -> ((step * e1 + low * e2) * (1 + e3) + (step + low) * e3 - ol * e4) * (1 + e5) * (1 + e6)
    + (step + low - ol) * (e5 + e6 + e5 * e6) + rest * e6;
v_w_low - (vrest + v_step + v_low - vol) ->
    ((v_step * e1 + v_low * e2) * (1 + e3) + (v_step + v_low) * e3 - vol * e4) * (1 + e5) * (1 + e6)
    + (v_step + v_low - vol) * (e5 + e6 + e5 * e6) + vrest * e6;
