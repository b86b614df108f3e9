//! The atoms of a crystal of potassium fulleride, K₃C₆₀: eight unit cells. Lengths are in ångström.

use eyeray::Sphere;
use glam::{Vec3, vec3};

/// An atom, and the sphere that stands for it.
pub(crate) struct Atom {
    pub(crate) element: Element,
    pub(crate) sphere: Sphere,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Element {
    Carbon,
    Potassium,
}

impl Element {
    /// The covalent radius of carbon, with which bonded atoms just touch, and the radius of the ion K⁺.
    pub(crate) const fn radius(self) -> f32 {
        match self {
            Self::Carbon => 0.76,
            Self::Potassium => 1.38,
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Carbon => "carbon",
            Self::Potassium => "potassium",
        }
    }

    pub(crate) const fn color(self) -> Vec3 {
        match self {
            Self::Carbon => vec3(0.11, 0.13, 0.17),
            Self::Potassium => vec3(0.36, 0.12, 0.62),
        }
    }
}

/// The edge of a unit cell.
const CELL: f32 = 14.24;

/// How many cells there are along each edge of the crystal.
const CELLS: i16 = 2;

/// The atoms, around the world's origin.
pub(crate) fn atoms() -> Vec<Atom> {
    let mut atoms = Vec::new();
    // Counted in quarters of a cell. The molecules are where the coordinates are all even and their halves have an even sum: at
    // the corners and in the middles of the faces of the cells.
    let end = 2 * CELLS;
    let quarters = || -end..=end;
    for [x, y, z] in
        quarters().flat_map(|x| quarters().flat_map(move |y| quarters().map(move |z| [x, y, z])))
    {
        let place = vec3(x.into(), y.into(), z.into()) * (CELL / 4.0);
        let even = [x, y, z].map(|coordinate| coordinate % 2 == 0);
        let is_molecule = (x + y + z) % 4 == 0;
        match even {
            [true, true, true] if is_molecule => atoms.extend(
                buckminsterfullerene().map(|offset| Atom::new(Element::Carbon, place + offset)),
            ),
            // Among six molecules, and among four.
            [true, true, true] | [false, false, false] => {
                atoms.push(Atom::new(Element::Potassium, place));
            }
            _ => {}
        }
    }
    atoms
}

impl Atom {
    fn new(element: Element, center: Vec3) -> Self {
        Self { element, sphere: Sphere::new(center, element.radius()) }
    }
}

/// The 60 atoms of a molecule around its center: the corners of a truncated icosahedron.
fn buckminsterfullerene() -> impl Iterator<Item = Vec3> {
    /// The golden ratio.
    const PHI: f32 = 1.618_034;
    /// Half the length of a bond, on average.
    const HALF_BOND: f32 = 0.72;
    const CORNERS: [Vec3; 3] = [
        vec3(0.0, 1.0, 3.0 * PHI),
        vec3(1.0, 2.0 + PHI, 2.0 * PHI),
        vec3(2.0, 1.0 + 2.0 * PHI, PHI),
    ];
    const SIGNS: [f32; 2] = [1.0, -1.0];
    CORNERS
        .into_iter()
        .flat_map(|corner| {
            SIGNS.into_iter().flat_map(move |x| {
                SIGNS.into_iter().flat_map(move |y| {
                    SIGNS.into_iter().filter_map(move |z| {
                        // Zero has one sign.
                        (corner.x != 0.0 || x > 0.0).then_some(corner * vec3(x, y, z))
                    })
                })
            })
        })
        // The corners of the same kind differ in which axis is which, in cyclic order.
        .flat_map(|corner| {
            [corner, vec3(corner.y, corner.z, corner.x), vec3(corner.z, corner.x, corner.y)]
        })
        .map(|corner| HALF_BOND * corner)
}
