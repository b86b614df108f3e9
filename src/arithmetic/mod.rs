//! The arithmetic that the two derivations are carried out in.

pub(crate) mod comparison;
pub(crate) mod float;
pub(crate) mod integer;
pub(crate) mod number;
pub(crate) mod pair;
pub(crate) mod product;
pub(crate) mod rounding;
pub(crate) mod scaling;
pub(crate) mod wide;
