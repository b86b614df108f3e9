//! What a user writes who needs all crossings: a binary tree, all roots of what the ray may meet, and a sort.

use eyeray::{Ray, Sphere};
use glam::Vec3;

/// How many spheres are in a leaf at most.
const LEAF: usize = 4;

/// A tree of boxes, split at the median of the longest axis.
pub(crate) struct Tree {
    /// The root first.
    nodes: Vec<Node>,
    /// In the order of the leaves, with their indices.
    spheres: Vec<(Sphere, usize)>,
}

struct Node {
    low: Vec3,
    high: Vec3,
    content: Content,
}

enum Content {
    Spheres { first: usize, end: usize },
    Nodes([usize; 2]),
}

impl Tree {
    pub(crate) fn new(spheres: &[Sphere]) -> Self {
        let spheres: Vec<_> = spheres.iter().copied().zip(0..).collect();
        let mut tree = Self { nodes: Vec::new(), spheres };
        tree.split(0, tree.spheres.len());
        tree
    }

    /// Makes a node of the spheres from `first` on, and returns its place.
    fn split(&mut self, first: usize, end: usize) -> usize {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for (sphere, _) in &self.spheres[first..end] {
            let bounds = sphere.bounds();
            (low, high) = (low.min(bounds.0), high.max(bounds.1));
        }
        let place = self.nodes.len();
        self.nodes.push(Node { low, high, content: Content::Spheres { first, end } });
        if end - first > LEAF {
            let axis = (high - low).max_position();
            let middle = first.midpoint(end);
            self.spheres[first..end].select_nth_unstable_by(middle - first, |(a, _), (b, _)| {
                a.center[axis].total_cmp(&b.center[axis])
            });
            let halves = [self.split(first, middle), self.split(middle, end)];
            self.nodes[place].content = Content::Nodes(halves);
        }
        place
    }

    /// The distances and the indices of all crossings ahead, by ascending distance.
    pub(crate) fn crossings(&self, ray: &Ray) -> Vec<(f32, usize)> {
        let reciprocal = ray.direction.recip();
        let mut crossings = Vec::new();
        let mut waiting = vec![0];
        while let Some(place) = waiting.pop() {
            let Node { low, high, content } = &self.nodes[place];
            let lows = (*low - ray.origin) * reciprocal;
            let highs = (*high - ray.origin) * reciprocal;
            let enter = lows.min(highs).max_element().max(0.0);
            let leave = lows.max(highs).min_element();
            if enter > leave {
                continue;
            }
            match *content {
                Content::Nodes(halves) => waiting.extend(halves),
                Content::Spheres { first, end } => {
                    for (sphere, index) in &self.spheres[first..end] {
                        let roots = sphere.roots(ray);
                        let ahead = roots.into_iter().flatten().filter(|t| *t > 0.0);
                        crossings.extend(ahead.map(|t| (t, *index)));
                    }
                }
            }
        }
        crossings.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        crossings
    }
}
