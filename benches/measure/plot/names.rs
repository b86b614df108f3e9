//! Where the names of a panel's marks go: near their marks, and clear of one another.

use super::{BAND, FONT_SIZE, MARK_RADIUS, Mark, PANEL_HEIGHT, PANEL_WIDTH};

/// Orders in which the names are placed. Of the pictures that they lead to, the best is taken.
const ORDERS: u32 = 200;
/// Between a mark and a name beside it.
const BESIDE: f64 = MARK_RADIUS + 3.0;
/// A name farther from its mark than this needs a line to it.
const NEAR: f64 = BESIDE + 1.0;

type Point = (f64, f64);

/// A rectangle of the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Area {
    /// The square around a mark.
    fn around((x, y): Point) -> Self {
        let r = MARK_RADIUS;
        Self { left: x - r, top: y - r, width: 2.0 * r, height: 2.0 * r }
    }

    fn grown(self, horizontally: f64, vertically: f64) -> Self {
        Self {
            left: self.left - horizontally,
            top: self.top - vertically,
            width: self.width + 2.0 * horizontally,
            height: self.height + 2.0 * vertically,
        }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.left < other.left + other.width
            && other.left < self.left + self.width
            && self.top < other.top + other.height
            && other.top < self.top + self.height
    }

    fn contains(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.left + other.width <= self.left + self.width
            && self.top <= other.top
            && other.top + other.height <= self.top + self.height
    }

    /// The point of the area that is nearest to another.
    fn nearest(&self, (x, y): Point) -> Point {
        (x.clamp(self.left, self.left + self.width), y.clamp(self.top, self.top + self.height))
    }

    fn distance(&self, point: Point) -> f64 {
        let (x, y) = self.nearest(point);
        (x - point.0).hypot(y - point.1)
    }

    /// Whether a segment passes through the area: by the part of the segment that is between each two sides.
    fn is_crossed(&self, [from, to]: [Point; 2]) -> bool {
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (from, to, low, size) in
            [(from.0, to.0, self.left, self.width), (from.1, to.1, self.top, self.height)]
        {
            let along = to - from;
            if along.abs() < 1e-9 {
                if from <= low || from >= low + size {
                    return false;
                }
            } else {
                let (one, other) = ((low - from) / along, (low + size - from) / along);
                start = start.max(one.min(other));
                end = end.min(one.max(other));
            }
        }
        start < end
    }
}

/// Whether two segments cross.
fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |p: Point, q: Point, r: Point| (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Where a name goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Name {
    pub(super) area: Area,
    /// The line from the name to its mark, where it needs one.
    pub(super) leader: Option<[Point; 2]>,
}

/// Where the names of marks at these places go.
pub(super) fn place(marks: &[Mark], places: &[Point]) -> Vec<Name> {
    let mut order: Vec<usize> = (0..marks.len()).collect();
    order.sort_by(|&i, &j| places[j].0.total_cmp(&places[i].0));
    let mut best: Option<(f64, Vec<Name>)> = None;
    let mut random = 1_u32;
    for _ in 0..ORDERS {
        let (cost, names) = place_in_order(&order, marks, places);
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, names));
        }
        for last in (1..order.len()).rev() {
            // The generator of Numerical Recipes, §7.1: the picture of the same figures is always the same.
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            order.swap(last, (random >> 16) as usize % (last + 1));
        }
    }
    best.map(|(_, names)| names).unwrap_or_default()
}

/// Gives each name in turn the best place that is left. Returns what they cost together.
fn place_in_order(order: &[usize], marks: &[Mark], places: &[Point]) -> (f64, Vec<Name>) {
    let mut names: Vec<Option<Name>> = vec![None; marks.len()];
    let mut sum = 0.0;
    for &index in order {
        let placed: Vec<Name> = names.iter().flatten().copied().collect();
        let (cost, name) = best_place(index, marks[index].label, places, &placed);
        sum += cost;
        names[index] = Some(name);
    }
    (sum, names.into_iter().flatten().collect())
}

/// The best place for the name of a mark, and what it costs: about its distance in pixels.
fn best_place(index: usize, label: &str, places: &[Point], placed: &[Name]) -> (f64, Name) {
    let (x, y) = places[index];
    let (width, height) = (text_width(label), FONT_SIZE + 1.0);
    let beside = [
        (x + BESIDE, y - height / 2.0),
        (x - BESIDE - width, y - height / 2.0),
        (x - width / 2.0, y - BESIDE - height + 2.0),
        (x - width / 2.0, y + BESIDE - 2.0),
    ];
    // Rows above and beneath, from beyond the one side of the mark to beyond the other.
    let around = (-8..=8).flat_map(|row| {
        let top = y - height / 2.0 + 13.0 * f64::from(row);
        (-40..=12).map(move |step| (x + 8.0 + 6.0 * f64::from(step), top))
    });
    let candidates =
        beside.into_iter().chain(around).map(|(left, top)| Area { left, top, width, height });
    let mut best = (f64::INFINITY, Name { area: Area::around((x, y)), leader: None });
    for area in candidates {
        if area.distance((x, y)) >= best.0 {
            continue;
        }
        let name = with_leader(area, index, places);
        let cost = cost(&name, index, places, placed);
        if cost < best.0 {
            best = (cost, name);
        }
    }
    best
}

/// The name there, with a line to its mark where it is not beside it, or no nearer to it than to another.
fn with_leader(area: Area, index: usize, places: &[Point]) -> Name {
    let distance = area.distance(places[index]);
    let is_nearest = places
        .iter()
        .enumerate()
        .all(|(other, &place)| other == index || area.distance(place) > distance + 1.0);
    let leader =
        (distance > NEAR || !is_nearest).then(|| [area.nearest(places[index]), places[index]]);
    Name { area, leader }
}

fn cost(name: &Name, index: usize, places: &[Point], placed: &[Name]) -> f64 {
    const PANEL: Area =
        Area { left: 2.0, top: 2.0, width: PANEL_WIDTH - 4.0, height: PANEL_HEIGHT - 4.0 };
    /// The words in the band.
    const WORDS: Area = Area { left: 0.0, top: PANEL_HEIGHT - 17.0, width: 185.0, height: 17.0 };

    let Name { area, leader } = name;
    let is_covered = !PANEL.contains(area)
        || WORDS.overlaps(area)
        || places.iter().any(|&place| Area::around(place).overlaps(area))
        || placed.iter().any(|other| {
            other.area.grown(7.0, 1.0).overlaps(area)
                || other.leader.is_some_and(|leader| area.grown(1.0, 1.0).is_crossed(leader))
        });
    if is_covered {
        return 1e6;
    }
    let mut cost = area.distance(places[index]);
    // Above the line of what is correctly rounded a name should not look as if it were, nor beneath as if it were not.
    let edge = PANEL_HEIGHT - BAND;
    if (area.top + area.height / 2.0 > edge) != (places[index].1 > edge) {
        cost += 20.0;
    }
    if let Some(leader) = *leader {
        cost += 10.0;
        let through = |area: &Area| area.is_crossed(leader);
        let names = placed.iter().filter(|other| through(&other.area)).count();
        let lines = placed.iter().filter_map(|other| other.leader);
        let lines = lines.filter(|&other| cross(leader, other)).count();
        let marks = places.iter().enumerate().filter(|&(other, &place)| {
            other != index
                && place != places[index]
                && through(&Area::around(place).grown(-1.5, -1.5))
        });
        #[expect(clippy::cast_precision_loss, reason = "there are few")]
        let [names, lines, marks] = [names, lines, marks.count()].map(|count| count as f64);
        cost += 1000.0 * names + 100.0 * lines + 150.0 * marks;
    }
    cost
}

/// The width of a text in the widest of the fonts, `DejaVu Sans`.
pub(super) fn text_width(text: &str) -> f64 {
    let em = |letter: char| match letter {
        'i' | 'j' | 'l' | ' ' | '-' | '.' | ',' | ':' | '\'' => 0.32,
        'f' | 'r' | 't' => 0.41,
        'm' | 'w' | 'M' | 'W' => 0.97,
        'A'..='Z' => 0.7,
        _ => 0.63,
    };
    FONT_SIZE * text.chars().map(em).sum::<f64>()
}
