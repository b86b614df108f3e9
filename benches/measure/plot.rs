//! Time against worst error, as an SVG.
//!
//! Both axes are logarithmic. Beneath the errors, a band of its own holds the methods that are never wrong and correctly
//! rounded. Every panel has the same axes, and shows the Pareto front: the methods than which no other is both faster and more
//! accurate. The picture brings its own background, light or dark as the reader prefers.

mod names;

use std::fmt::Write as _;

use self::names::{Name, text_width};
use super::Kind;

/// The description of the picture, as alternative text.
pub const ALT_TEXT: &str = "Time a test against worst error in ulps, both logarithmic: a panel for each group of \
families, a named mark for each method, and the Pareto front. The tables give the same figures.";

/// A method in a group of families.
#[derive(Clone, Debug)]
pub struct Mark {
    pub label: &'static str,
    pub kind: Kind,
    pub nanoseconds: f64,
    /// The worst error.
    pub ulps: f64,
    pub correctly_rounded: bool,
    pub decides_wrongly: bool,
}

/// A group of families.
#[derive(Clone, Debug)]
pub struct Panel {
    pub title: &'static str,
    pub marks: Vec<Mark>,
}

const WIDTH: f64 = 880.0;
const COLUMNS: usize = 2;
const HEAD: f64 = 64.0;
const FOOT: f64 = 44.0;
const PANEL_WIDTH: f64 = 375.0;
const PANEL_HEIGHT: f64 = 290.0;
const LEFT: f64 = 58.0;
const GAP: f64 = 60.0;
const ROW_HEIGHT: f64 = PANEL_HEIGHT + 64.0;
/// The power of ten of the ulps at which the axis ends. What is beyond stands there too.
const WORST: i32 = 12;
/// The height of the band for what is correctly rounded.
const BAND: f64 = 82.0;

const FONT_SIZE: f64 = 11.0;
const MARK_RADIUS: f64 = 4.5;
/// Room above the worst errors, for the names of what stands there.
const HEADROOM: f64 = 30.0;

/// Colors are named once for light and once for dark, without CSS variables, which not every viewer knows.
const STYLE: &str = "
  text { font: 11px system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif; fill: #24292f }
  .title { font-size: 13px; font-weight: 600 } .end { text-anchor: end } .middle { text-anchor: middle }
  .mark { stroke-width: 1.5 } .name { paint-order: stroke; stroke-width: 3; stroke-linejoin: round }
  .front { fill: none; stroke-width: 1.5; stroke-dasharray: 5 3 } .leader { stroke-width: 0.7 } .frame { fill: none }
  .paper { fill: #ffffff } .band { fill: #e6f4ea } .grid { stroke: #d8dee4 }
  .front, .frame, .leader { stroke: #8c959f }
  .plain { fill: #9a6700; stroke: #9a6700 } .widened { fill: #0969da; stroke: #0969da }
  .eyeray { fill: #1a7f37; stroke: #1a7f37 } .mark.wrong { fill: #ffffff }
  .name { stroke: #ffffff }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3 }
    .paper { fill: #0d1117 } .band { fill: #12261e } .grid { stroke: #30363d }
    .front, .frame, .leader { stroke: #7d8590 }
    .plain { fill: #d29922; stroke: #d29922 } .widened { fill: #58a6ff; stroke: #58a6ff }
    .eyeray { fill: #3fb950; stroke: #3fb950 } .mark.wrong { fill: #0d1117 }
    .name { stroke: #0d1117 }
  }
";

/// The time axis that all panels share: the logarithms of the nanoseconds at the left and at the right.
struct TimeAxis {
    left: f64,
    right: f64,
}

impl TimeAxis {
    fn new(panels: &[Panel]) -> Self {
        let times =
            || panels.iter().flat_map(|panel| &panel.marks).map(|mark| mark.nanoseconds.log10());
        Self {
            left: times().fold(f64::INFINITY, f64::min) - 0.15,
            right: times().fold(f64::NEG_INFINITY, f64::max) + 0.15,
        }
    }

    fn x(&self, nanoseconds: f64) -> f64 {
        PANEL_WIDTH * (nanoseconds.log10() - self.left) / (self.right - self.left)
    }

    fn place(&self, mark: &Mark) -> (f64, f64) {
        let y = if mark.correctly_rounded {
            PANEL_HEIGHT - BAND / 2.0 - 5.0
        } else {
            error_y(mark.ulps)
        };
        (self.x(mark.nanoseconds), y)
    }
}

/// Where so many ulps are, above the band.
fn error_y(ulps: f64) -> f64 {
    let (least, worst) = (-0.8, f64::from(WORST));
    let part = (ulps.log10().clamp(-0.5, worst) - least) / (worst - least);
    HEADROOM + (PANEL_HEIGHT - BAND - HEADROOM) * (1.0 - part)
}

/// The picture of the panels.
pub fn draw(title: &str, panels: &[Panel]) -> String {
    #[expect(clippy::cast_precision_loss, reason = "panels are few")]
    let height = HEAD + ROW_HEIGHT * panels.len().div_ceil(COLUMNS) as f64 + FOOT - 20.0;
    let axis = TimeAxis::new(panels);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" \
role=\"img\">\n<title>{title}</title>\n<desc>{ALT_TEXT}</desc>\n<style>{STYLE}</style>\n\
<rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\" rx=\"8\"/>\n\
<text class=\"title\" x=\"{LEFT}\" y=\"24\">{title}</text>\n"
    );
    legend(&mut svg, panels);
    for (index, panel) in panels.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "panels are few")]
        let (column, row) = ((index % COLUMNS) as f64, (index / COLUMNS) as f64);
        let (x, y) = (LEFT + column * (PANEL_WIDTH + GAP), HEAD + 22.0 + row * ROW_HEIGHT);
        let _ = writeln!(svg, "<g transform=\"translate({x} {y})\">");
        draw_panel(&mut svg, panel, &axis);
        svg += "</g>\n";
    }
    svg += "</svg>\n";
    svg
}

fn legend(svg: &mut String, panels: &[Panel]) {
    let entries = [
        (Kind::Plain, false, "in the inputs' precision"),
        (Kind::Widened, false, "in f64 on f32 inputs"),
        (Kind::Eyeray, false, "eyeray"),
        (Kind::Plain, true, "hollow: some hits or misses wrong"),
    ];
    let mut x = LEFT + MARK_RADIUS;
    let used = |kind| panels.iter().flat_map(|panel| &panel.marks).any(|mark| mark.kind == kind);
    for (kind, hollow, text) in entries.into_iter().filter(|entry| used(entry.0)) {
        symbol(svg, (x, 42.0), kind, hollow);
        let _ = writeln!(svg, "<text x=\"{:.0}\" y=\"46\">{text}</text>", x + 10.0);
        x += 34.0 + text_width(text);
    }
    let _ = writeln!(
        svg,
        "<path class=\"front\" d=\"M{x} 42h26\"/><text x=\"{:.0}\" y=\"46\">Pareto front</text>",
        x + 32.0
    );
}

fn draw_panel(svg: &mut String, panel: &Panel, axis: &TimeAxis) {
    let band_top = PANEL_HEIGHT - BAND;
    let _ = writeln!(
        svg,
        "<text class=\"title\" x=\"0\" y=\"-8\">{}</text>\n\
<rect class=\"band\" y=\"{band_top}\" width=\"{PANEL_WIDTH}\" height=\"{BAND}\"/>",
        panel.title
    );
    draw_axes(svg, axis);
    let _ = writeln!(
        svg,
        "<rect class=\"frame\" width=\"{PANEL_WIDTH}\" height=\"{PANEL_HEIGHT}\"/>\n\
<text x=\"6\" y=\"{:.0}\">0 wrong, correctly rounded</text>",
        PANEL_HEIGHT - 5.0
    );

    let places: Vec<_> = panel.marks.iter().map(|mark| axis.place(mark)).collect();
    let front: Vec<String> =
        front(&places).into_iter().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
    let _ = writeln!(svg, "<path class=\"front\" d=\"M{}\"/>", front.join("L"));

    for (name, mark) in names::place(&panel.marks, &places).iter().zip(&panel.marks) {
        draw_name(svg, name, mark);
    }
    for (mark, &place) in panel.marks.iter().zip(&places) {
        symbol(svg, place, mark.kind, mark.decides_wrongly);
    }
}

fn draw_axes(svg: &mut String, axis: &TimeAxis) {
    let band_top = PANEL_HEIGHT - BAND;
    for nanoseconds in
        (0..5).flat_map(|power| [1, 2, 5].map(|digit| f64::from(digit) * 10_f64.powi(power)))
    {
        let x = axis.x(nanoseconds);
        if (0.0..=PANEL_WIDTH).contains(&x) {
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{x:.1} 0V{PANEL_HEIGHT}\"/>\
<text class=\"middle\" x=\"{x:.1}\" y=\"{:.0}\">{nanoseconds}</text>",
                PANEL_HEIGHT + 15.0
            );
        }
    }
    let _ = writeln!(
        svg,
        "<text class=\"middle\" x=\"{:.0}\" y=\"{:.0}\">ns a test, branches predicted</text>",
        PANEL_WIDTH / 2.0,
        PANEL_HEIGHT + 30.0
    );

    for power in (0..=WORST).step_by(2) {
        let name = match power {
            0 => "1".into(),
            WORST => format!("≥10{}", superscript(power)),
            _ => format!("10{}", superscript(power)),
        };
        let y = error_y(10_f64.powi(power));
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M0 {y:.1}H{PANEL_WIDTH}\"/>\
<text class=\"end\" x=\"-5\" y=\"{:.1}\">{name}</text>",
            y + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<text class=\"middle\" transform=\"translate(-38 {:.0}) rotate(-90)\">worst error in ulps</text>",
        band_top / 2.0
    );
}

fn superscript(number: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    number.to_string().bytes().map(|digit| DIGITS[usize::from(digit - b'0')]).collect()
}

/// The places than which none is both further left and lower, from left to right.
fn front(places: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut lowest = f64::NEG_INFINITY;
    sorted.retain(|&(_, y)| {
        let lower = y > lowest + 0.5;
        lowest = lowest.max(y);
        lower
    });
    sorted
}

fn class(kind: Kind) -> &'static str {
    match kind {
        Kind::Plain => "plain",
        Kind::Widened => "widened",
        Kind::Eyeray => "eyeray",
    }
}

/// A circle, a square or a diamond.
fn symbol(svg: &mut String, (x, y): (f64, f64), kind: Kind, hollow: bool) {
    let class = format!("class=\"mark {}{}\"", class(kind), if hollow { " wrong" } else { "" });
    let r = MARK_RADIUS;
    let _ = match kind {
        Kind::Plain => {
            writeln!(svg, "<circle {class} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{}\"/>", r - 0.5)
        }
        Kind::Widened => writeln!(
            svg,
            "<rect {class} x=\"{:.1}\" y=\"{:.1}\" width=\"{}\" height=\"{}\"/>",
            x - r + 0.8,
            y - r + 0.8,
            2.0 * r - 1.6,
            2.0 * r - 1.6
        ),
        Kind::Eyeray => {
            writeln!(svg, "<path {class} d=\"M{x:.1} {:.1}l{r} {r}l-{r} {r}l-{r} -{r}z\"/>", y - r)
        }
    };
}

fn draw_name(svg: &mut String, name: &Name, mark: &Mark) {
    let Name { area, leader } = name;
    if let Some([(from_x, from_y), (x, y)]) = leader {
        let _ =
            writeln!(svg, "<path class=\"leader\" d=\"M{from_x:.1} {from_y:.1}L{x:.1} {y:.1}\"/>");
    }
    let _ = writeln!(
        svg,
        "<text class=\"{} name\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
        class(mark.kind),
        area.left,
        area.top + area.height - 2.5,
        mark.label
    );
}
