//! The arithmetic that the two derivations are carried out in.

pub(crate) mod comparison;
pub(crate) mod half;
pub(crate) mod integer;
pub(crate) mod number;
pub(crate) mod pair;
pub(crate) mod product;
pub(crate) mod rounding;
pub(crate) mod scaled_float;
pub(crate) mod scaled_pair;
pub(crate) mod scaling;
