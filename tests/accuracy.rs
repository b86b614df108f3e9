//! How accurate the roots are, family by family, against exact arithmetic.

mod support;
