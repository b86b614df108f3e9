//! The report: every method on every family, as a table, as Markdown, as CSV and as a plot.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use indicatif::{ProgressBar, ProgressStyle};

use super::accuracy::{self, Summary};
use super::arguments::{Arguments, Effort};
use super::groups::{self, GROUPS, Group};
use super::plot::{self, Mark, Panel};
use super::price::{self, Predicted, Prices, Questions};
use super::timing::{self, Regime};
use super::{Kind, Measured, Method, SEED, Timed, cases, conditions, page};
use crate::support::families::{FAMILIES, Family};

/// What was measured of a method on a family.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub family: &'static Family,
    pub method: &'static str,
    pub kind: Kind,
    pub errors: Summary,
    pub predicted: Predicted,
    /// How many times the first method's on this family.
    pub predicted_ratio: f64,
    /// Nanoseconds a test, and how many times the first method's.
    pub unpredicted: f64,
    pub unpredicted_ratio: f64,
}

/// One precision's part of a report.
pub struct Part {
    precision: &'static str,
    sources: Vec<(&'static str, &'static str)>,
    rows: Vec<Row>,
    accuracy_cases: usize,
    prices: Option<Prices>,
}

/// The line that says how far a run is.
pub fn progress(parts: usize) -> ProgressBar {
    let bar = ProgressBar::new((parts * FAMILIES.len()) as u64);
    let template = "{elapsed_precise} {bar:30} {pos}/{len} {msg}";
    bar.with_style(
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()),
    )
}

/// Measures every method on every family. The first method is the one that the others are compared with.
///
/// With questions, the report opens with the prices of all that a sphere is asked for.
pub fn measure<V: Measured>(
    methods: &[Method<V>],
    questions: Option<&Questions<V>>,
    full_accuracy_cases: usize,
    effort: Effort,
    progress: &ProgressBar,
) -> Part {
    let accuracy_cases = effort.cases(full_accuracy_cases);
    let tests: Vec<_> = methods.iter().map(|method| -> &dyn Timed<V> { method }).collect();
    let mut rows = Vec::new();
    for family in groups::families() {
        let message = format!("{}, {}", V::NAME, family.name);
        if progress.is_hidden() {
            eprintln!("{message}");
        }
        progress.set_message(message);
        let tallies = accuracy::judge(family, methods, accuracy_cases);
        let predicted = price::predicted(&tests, tests[0], family, effort);
        let unpredicted = {
            let regime = effort.regime(Regime::UNPREDICTED);
            let cases = cases::<V>(family, SEED, regime.cases);
            let turns = tests.iter().map(|test| test.turn(&cases)).collect();
            timing::medians_of_turns(turns, cases.len(), regime)
        };
        for (index, (method, tally)) in methods.iter().zip(tallies).enumerate() {
            rows.push(Row {
                family,
                method: method.name,
                kind: method.kind,
                errors: tally.summary(),
                predicted: predicted[index],
                predicted_ratio: predicted[index].price / predicted[0].price,
                unpredicted: unpredicted[index],
                unpredicted_ratio: unpredicted[index] / unpredicted[0],
            });
        }
        progress.inc(1);
    }
    let prices = questions.map(|questions| {
        let ours = rows.iter().filter(|row| row.method == OURS);
        Prices::new(ours.map(|row| (row.family, row.predicted)), questions, effort)
    });
    let sources = methods.iter().map(|method| (method.name, method.source)).collect();
    Part { precision: V::NAME, sources, rows, accuracy_cases, prices }
}

/// The prices alone.
pub fn prices<V: Measured>(
    ours: &Method<V>,
    questions: &Questions<V>,
    effort: Effort,
    progress: &ProgressBar,
) -> Prices {
    let nearest = groups::families().map(|family| {
        progress.set_message(format!("{}, {}", V::NAME, family.name));
        progress.inc(1);
        (family, price::predicted(&[ours], questions.textbook(), family, effort)[0])
    });
    Prices::new(nearest.collect::<Vec<_>>(), questions, effort)
}

/// Methods that are not among the few columns of the report's first page.
const LESS_KNOWN: [&str; 6] =
    ["geometric", "stable", "Haines", "textbook f64", "eyeray algebraic", "eyeray geometric"];

/// The name of the method whose prices are told.
pub const OURS: &str = "eyeray";

/// What a group's families come to for a method: wrong decisions in all of their cases, the worst of their errors, the mean
/// of their times.
#[derive(Clone, Copy, Debug)]
struct Overall {
    wrong: f64,
    worst: f64,
    correctly_rounded: bool,
    predicted: f64,
    unpredicted: f64,
}

impl Part {
    fn overall(&self, group: &Group, method: &str) -> Overall {
        let rows = || {
            self.rows
                .iter()
                .filter(|row| row.method == method && group.families.contains(&row.family.name))
        };
        #[expect(clippy::cast_precision_loss, reason = "families are few")]
        let mean = |value: fn(&Row) -> f64| rows().map(value).sum::<f64>() / rows().count() as f64;
        let judged: f64 = rows().map(|row| row.errors.judged).sum();
        let wrong = rows().filter(|row| row.errors.judged > 0.0);
        Overall {
            wrong: wrong.map(|row| row.errors.wrong * row.errors.judged).sum::<f64>() / judged,
            worst: rows().map(|row| row.errors.worst).fold(f64::NAN, f64::max),
            correctly_rounded: rows()
                .filter(|row| row.errors.judged > 0.0)
                .all(|row| row.errors.correctly_rounded),
            predicted: mean(|row| row.predicted.nanoseconds),
            unpredicted: mean(|row| row.unpredicted),
        }
    }

    fn methods(&self) -> impl Iterator<Item = (&'static str, Kind)> {
        self.rows.iter().take(self.sources.len()).map(|row| (row.method, row.kind))
    }

    /// Time against worst error, a panel for each group.
    fn plot(&self) -> String {
        let panels: Vec<Panel> = GROUPS
            .iter()
            .map(|group| {
                let marks = self.methods().map(|(method, kind)| {
                    let overall = self.overall(group, method);
                    Mark {
                        label: method,
                        kind,
                        nanoseconds: overall.predicted,
                        ulps: overall.worst,
                        correctly_rounded: overall.correctly_rounded,
                        decides_wrongly: overall.wrong > 0.0,
                    }
                });
                // Without an answer that was judged there is no place for a mark.
                let marks = marks.filter(|mark| !mark.ulps.is_nan());
                Panel { title: group.name, marks: marks.collect() }
            })
            .collect();
        plot::draw(&format!("{} rays and spheres: speed against error", self.precision), &panels)
    }

    fn markdown(&self, image: &str) -> String {
        let mut text = format!("## {} inputs\n\n", self.precision);
        if let Some(prices) = &self.prices {
            let _ = writeln!(
                text,
                "### The price\n\nThe time of the nearest root by `Sphere::intersect`, in multiples of the textbook's for \
the nearest root on the easy family in {}, which takes its turn in the same rounds; branches predicted.\n\n{}",
                self.precision,
                prices.table()
            );
        }
        let _ = writeln!(text, "![{}]({image})\n", plot::ALT_TEXT);
        for (name, source) in &self.sources {
            let _ = writeln!(text, "- **{name}**: {source}");
        }
        let _ = writeln!(
            text,
            "\nErrors over {} cases a family.\n\n### Groups of families\n",
            self.accuracy_cases
        );
        let mut table = Table::new(&[
            "group",
            "method",
            "wrong in 10⁶",
            "worst ulps",
            "ns",
            "ratio",
            "ns unpredicted",
            "ratio",
        ]);
        for group in &GROUPS {
            let first = self.overall(group, self.sources[0].0);
            for (method, _) in self.methods() {
                let overall = self.overall(group, method);
                table.row([
                    group.name.into(),
                    method.into(),
                    count(overall.wrong),
                    worst(overall.worst, overall.correctly_rounded),
                    format!("{:.1}", overall.predicted),
                    format!("{:.2}", overall.predicted / first.predicted),
                    format!("{:.1}", overall.unpredicted),
                    format!("{:.2}", overall.unpredicted / first.unpredicted),
                ]);
            }
        }
        text += &table.to_string();
        for family in groups::families() {
            let _ = writeln!(text, "\n### {}: {}\n", family.name, family.description);
            text += &self.family_table(family).to_string();
        }
        text
    }

    /// The methods that are known best.
    fn well_known(&self) -> impl Iterator<Item = &'static str> {
        self.methods().map(|(method, _)| method).filter(|method| !LESS_KNOWN.contains(method))
    }

    /// A number for each group and each of the methods that are known best.
    fn in_short(&self, number: impl Fn(Overall) -> String) -> Table {
        let heads = std::iter::once("rays and spheres").chain(self.well_known());
        let mut table = Table::new(&heads.collect::<Vec<_>>());
        for group in &GROUPS {
            let cells = self.well_known().map(|method| number(self.overall(group, method)));
            table.row(std::iter::once(group.name.to_owned()).chain(cells).collect::<Vec<_>>());
        }
        table
    }

    fn family_table(&self, family: &Family) -> Table {
        let rows = || self.rows.iter().filter(|row| row.family.name == family.name);
        let any_apart = rows().any(|row| row.errors.apart > 0.0);
        let any_invalid = rows().any(|row| row.errors.invalid_hits.is_finite());
        let mut heads = vec![
            "method",
            "wrong in 10⁶",
            "other root in 10⁶",
            "median ulps",
            "99 % ulps",
            "worst ulps",
            "ns",
            "ratio",
            "ns unpredicted",
            "ratio",
        ];
        if any_apart {
            heads.push("not promised, in 10⁶");
        }
        if any_invalid {
            heads.push("hits on invalid input");
        }
        let mut table = Table::new(&heads);
        for row in rows() {
            let errors = &row.errors;
            let mut cells = vec![
                row.method.into(),
                count(errors.wrong),
                count(errors.other_root),
                ulps(errors.median),
                ulps(errors.percentile_99),
                worst(errors.worst, errors.correctly_rounded),
                format!("{:.1}", row.predicted.nanoseconds),
                format!("{:.2}", row.predicted_ratio),
                format!("{:.1}", row.unpredicted),
                format!("{:.2}", row.unpredicted_ratio),
            ];
            if any_apart {
                cells.push(count(errors.apart));
            }
            if any_invalid {
                cells.push(format!("{:.1} %", 100.0 * errors.invalid_hits));
            }
            table.row(cells);
        }
        table
    }

    fn csv(&self, text: &mut String) {
        for row in &self.rows {
            let errors = &row.errors;
            let _ = writeln!(
                text,
                "{},\"{}\",\"{}\",\"{}\",{},{},{},{},{},{},{},{},{:.3},{:.3},{:.3},{:.3},{:.3}",
                self.precision,
                groups::group_of(row.family).name,
                row.family.name,
                row.method,
                errors.wrong,
                errors.other_root,
                errors.apart,
                errors.invalid_hits,
                errors.median,
                errors.percentile_99,
                errors.worst,
                errors.correctly_rounded,
                row.predicted.nanoseconds,
                row.predicted_ratio,
                row.predicted.price,
                row.unpredicted,
                row.unpredicted_ratio,
            );
        }
    }
}

const CSV_HEAD: &str = "precision,group,family,method,wrong_per_million,other_root_per_million,\
not_promised_per_million,hits_on_invalid_input,median_ulps,percentile_99_ulps,worst_ulps,correctly_rounded,\
ns_predicted,ratio_predicted,price,ns_unpredicted,ratio_unpredicted\n";

/// Prints the report and writes it under cargo's target directory, and to `copies` too where a refresh was asked for.
pub fn publish(
    name: &str,
    introduction: &str,
    parts: &[Part],
    arguments: Arguments,
    copies: Option<&Path>,
) -> io::Result<()> {
    if arguments.effort == Effort::Test {
        return page::finish(name, arguments.effort, "");
    }
    let in_short = in_short(parts);
    let mut markdown =
        format!("# Speed against error\n\n{introduction}\n\n{}\n\n{in_short}\n", explanation());
    let mut csv = CSV_HEAD.to_owned();
    let mut files = Vec::new();
    for part in parts {
        let image = format!("{}.svg", part.precision);
        markdown += &part.markdown(&image);
        markdown.push('\n');
        part.csv(&mut csv);
        files.push((image, part.plot()));
    }
    files.push((format!("{name}.md"), markdown));
    files.push((format!("{name}.csv"), csv));

    let target = page::directory(name);
    let refreshed = copies.filter(|_| arguments.refresh).map(PathBuf::from);
    for directory in std::iter::once(target.clone()).chain(refreshed) {
        fs::create_dir_all(&directory)?;
        for (file, text) in &files {
            fs::write(directory.join(file), text)?;
        }
    }
    let summary = format!(
        "{introduction}\n\n{in_short}\nThe report: {}\n",
        target.join(format!("{name}.md")).display()
    );
    page::finish(name, arguments.effort, &summary)
}

/// What the README states.
fn in_short(parts: &[Part]) -> String {
    let mut text = String::new();
    let prices: Vec<_> = parts.iter().filter_map(|part| part.prices.as_ref()).collect();
    if !prices.is_empty() {
        let _ = writeln!(text, "{}\n\n{}", PRICES, price::in_short(&prices));
    }
    for Part { precision, accuracy_cases, .. } in parts {
        let _ = writeln!(
            text,
            "The first root ahead of one {precision} ray on one sphere, {accuracy_cases} cases a family.\n"
        );
    }
    for part in parts {
        let wrong = part.in_short(|overall| count(overall.wrong));
        let time = part.in_short(|overall| format!("{:.1}", overall.predicted));
        let error = part.in_short(|overall| worst(overall.worst, overall.correctly_rounded));
        let _ = writeln!(
            text,
            "Wrong hits or misses in a million, {precision}:\n\n{wrong}\nNanoseconds, branches predicted, \
{precision}:\n\n{time}\nWorst error in ulps (✓: every root correctly rounded, and no decision wrong), {precision}:\n\n{error}",
            precision = part.precision,
        );
    }
    text
}

/// Above the table of [`price::in_short`].
pub const PRICES: &str = "The time of the nearest root by `Sphere::intersect`, in multiples of the textbook's on the unit \
sphere at 2 to 10 in the same precision, branches predicted:";

fn explanation() -> String {
    format!(
        "A test finds the first root ahead of one ray on one sphere. *Wrong*: a hit called a miss, or a miss a hit. \
*Other root*: an answer nearer to the other root than to the first one ahead. *Ulps*: how far the answer is from the exact \
root, where there is one and the method found any; ✓ where every answer was the correctly rounded root and no decision \
was wrong. *ns*: nanoseconds a test where branches are predicted, {predicted} cases, in blocks of {block} that are gone through until \
the branch predictor has learned them; *unpredicted*: {unpredicted} cases, once each a round. Both are medians of rounds in \
which every method takes its turn, beside their ratio to the first method's on the same family. Input that is no ray or no sphere (a NaN, an infinity, a zero direction, a negative radius) is counted apart. \
The cases are those of the accuracy tests, with seeds from {SEED} on, a thousand cases each; those timed all with the seed {SEED}.\n\nMeasured on {conditions}",
        predicted = price::predicted_cases(),
        block = Regime::PREDICTED.cases,
        unpredicted = Regime::UNPREDICTED.cases,
        conditions = conditions::line(),
    )
}

/// A number in a million.
fn count(per_million: f64) -> String {
    if per_million.is_nan() {
        "–".into()
    } else if per_million > 0.0 && per_million < 10.0 {
        format!("{per_million:.1}")
    } else {
        format!("{per_million:.0}")
    }
}

fn ulps(value: f64) -> String {
    if value.is_nan() {
        "–".into()
    } else if value.is_infinite() {
        "∞".into()
    } else if value < 100.0 {
        format!("{value:.2}")
    } else if value < 1e5 {
        format!("{value:.0}")
    } else {
        format!("{value:.1e}")
    }
}

fn worst(value: f64, correctly_rounded: bool) -> String {
    if correctly_rounded && value.is_finite() {
        format!("{} ✓", ulps(value))
    } else {
        ulps(value)
    }
}

/// The heads of the columns that are aligned at the left.
const TEXT_COLUMNS: [&str; 5] = ["method", "group", "what", "compared with", "rays and spheres"];

/// A Markdown table, aligned to be read as plain text too.
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(heads: &[&str]) -> Self {
        Self { rows: vec![heads.iter().map(|&head| head.to_owned()).collect()] }
    }

    pub fn row(&mut self, cells: impl Into<Vec<String>>) {
        self.rows.push(cells.into());
    }
}

impl std::fmt::Display for Table {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let width = |column: usize| {
            self.rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.rows[0].len()).map(width).collect();
        let is_text = |column: usize| TEXT_COLUMNS.contains(&self.rows[0][column].as_str());
        for (index, row) in self.rows.iter().enumerate() {
            for (column, cell) in row.iter().enumerate() {
                let width = widths[column];
                if is_text(column) {
                    write!(formatter, "| {cell:width$} ")?;
                } else {
                    write!(formatter, "| {cell:>width$} ")?;
                }
            }
            writeln!(formatter, "|")?;
            if index == 0 {
                for (column, &width) in widths.iter().enumerate() {
                    let dashes = "-".repeat(width);
                    write!(
                        formatter,
                        "|{}",
                        if is_text(column) { format!(":{dashes}-") } else { format!("-{dashes}:") }
                    )?;
                }
                writeln!(formatter, "|")?;
            }
        }
        Ok(())
    }
}
