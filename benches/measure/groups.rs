//! The families in a handful of groups, for the plot.

use crate::support::families::{FAMILIES, Family};

/// Families with a similar cause of errors.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    pub name: &'static str,
    pub families: &'static [&'static str],
}

pub const GROUPS: [Group; 6] = [
    Group {
        name: "ordinary",
        families: &["easy", "inside", "behind", "axis-parallel", "direction length"],
    },
    Group {
        name: "far away or tiny",
        families: &[
            "far",
            "very far",
            "farthest",
            "far from the world's origin",
            "tiny",
            "tiniest",
        ],
    },
    Group { name: "huge spheres", families: &["huge", "hugest"] },
    Group {
        name: "grazing",
        families: &[
            "grazing",
            "at the limb",
            "grazing from afar",
            "at the limb from afar",
            "planet's limb",
            "exact tangent",
            "tangent's neighbor",
            "near tangent",
            "point sphere",
        ],
    },
    Group { name: "from the surface", families: &["on the surface", "on the surface, exactly"] },
    Group {
        name: "extreme values and ties",
        families: &[
            "extreme direction length",
            "scene scale",
            "subnormal",
            "near overflow",
            "coefficients, narrow",
            "coefficients, wide",
            "coefficients, widest",
            "random bits",
            "random finite bits",
            "exact tie",
            "near tie",
            "near tie beside the axis",
            "tie of a tiny sphere",
            "hard to round",
        ],
    },
];

/// The group of a family. Every family is in one.
pub fn group_of(family: &Family) -> &'static Group {
    let has = |group: &&Group| group.families.contains(&family.name);
    let group = GROUPS.iter().find(has);
    group.unwrap_or_else(|| panic!("the family \"{}\" is in no group", family.name))
}

/// The families, group by group.
pub fn families() -> impl Iterator<Item = &'static Family> {
    GROUPS
        .iter()
        .flat_map(|group| FAMILIES.iter().filter(|family| group_of(family).name == group.name))
}
