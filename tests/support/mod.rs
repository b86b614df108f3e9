//! What the tests share: cases to try, and exact arithmetic to judge by.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "shared by several tests, each of which takes what it needs"
)]

pub mod dyadic;
pub mod families;
pub mod float;
pub mod oracle;
pub mod order;
pub mod reproduce;
