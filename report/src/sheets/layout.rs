//! Layout of a sheet: cells in rows and columns between a heading and a ruler.

use super::codes::{least_distance, numbers};
use super::drawing::{Page, Shape};
use super::words::Words;
use super::{BarEnds, CLEAR, Ground, Pattern, Printed, RULER_MM, SheetOptions, Sheets, TargetKind};
use crate::reason::ReportReason;
use sightline::error::{Error, Place, Result};
use sightline::limits;
use sightline::noise::Noise;
use sightline::ring_code::{Design, Family};

/// Edges of what is printed, mm: left, top, right, bottom. The right one has the ruler down, the bottom one that across.
const EDGES: [f64; 4] = [12.0, 20.0, 20.0, 28.0];
/// Between cells, and room for a label below a cell.
const GAP: f64 = 3.0;
const LABEL: f64 = 3.5;
const LABEL_SIZE: f64 = 2.2;
/// Marks to cut along: their length, their way off the corner, and their width.
const CUT: [f64; 3] = [1.8, 0.4, 0.1];
/// Jittered dots stay within this share of what their cells leave.
const JITTER: f64 = 0.9;
/// Standard error of a printed distance beside that of the scale, mm.
const PRINTED_MM: f64 = 0.05;
/// In a calibration field every third cell along a row is a code.
const CODE_EVERY: usize = 3;

/// The drawing as it grows.
struct Draft<'a> {
    options: &'a SheetOptions,
    words: Words,
    pages: Vec<Page>,
    targets: Vec<Printed>,
    scale: [f64; 2],
    next_dot: u32,
}

/// A grid of equal cells on a sheet.
struct Grid {
    columns: usize,
    rows: usize,
    /// Size of a cell with its gap, mm.
    pitch: [f64; 2],
    /// Half of a target's square ground.
    half: f64,
}

/// The sheets of all that is wanted.
pub fn sheets(options: &SheetOptions) -> Result<Sheets> {
    let across = options.measured.map_or(1.0, |measured| measured / RULER_MM);
    let down = options.measured_down.map_or(across, |measured| measured / RULER_MM);
    let measured = options.measured.or(options.measured_down).is_some();
    let mut draft = Draft {
        options,
        words: Words(options.language),
        pages: Vec::new(),
        targets: Vec::new(),
        scale: [across, down],
        next_dot: 1,
    };
    let code_half = outer(Some(options.family.design())) * options.diameter / 2.0;
    let codes = grid(options, code_half)?;
    let fields = options.field.map_or(0, |field| (field.columns as usize).saturating_mul(field.rows as usize));
    let too_many = || {
        Err(Error::Invalid {
            reason: ReportReason::SheetTooMany { limit: limits::SHEETS }.into(),
            at: Place::field("codes"),
        })
    };
    // Before anything is counted out: on 32 bits the products of what is asked for would run over.
    if [options.bars as usize, fields].iter().any(|count| *count > limits::SHEETS) {
        return too_many();
    }
    // Codes are no more than their family has.
    for (count, field) in [(options.dots as usize, "dots"), (fields * codes.count(), "field")] {
        if count > limits::PRINTED {
            let reason = ReportReason::SheetTooManyTargets { limit: limits::PRINTED }.into();
            return Err(Error::Invalid { reason, at: Place::field(field) });
        }
    }
    let in_a_field = codes.cells().filter(|cell| is_code(*cell)).count() * fields;
    let (first, more) =
        numbers(options.family, &options.numbers, options.codes as usize, 2 * options.bars as usize + in_a_field)?;
    let (ends, on_plate) = more.split_at(2 * options.bars as usize);
    if first.len().div_ceil(codes.count()) + options.bars as usize + fields > limits::SHEETS {
        return too_many();
    }
    for part in first.chunks(codes.count()) {
        draft.begin(draft.words.codes(&family_name(options.family), part));
        for (cell, number) in codes.cells().zip(part) {
            let at = codes.at(cell);
            draft.target(at, codes.half, Some(*number), TargetKind::Code, None);
        }
    }
    let bars = draft.bars(&codes, ends);
    draft.dots()?;
    draft.field(&codes, on_plate);
    if draft.pages.is_empty() {
        return Err(Error::Invalid { reason: ReportReason::SheetNothing.into(), at: Place::field("codes") });
    }
    if draft.pages.len() > limits::SHEETS {
        return Err(Error::Invalid {
            reason: ReportReason::SheetTooMany { limit: limits::SHEETS }.into(),
            at: Place::field("dots"),
        });
    }
    let printed: Vec<u32> = draft.targets.iter().filter_map(|target| target.number).collect();
    let Draft { mut pages, targets, scale, .. } = draft;
    let count = pages.len();
    for (k, page) in pages.iter_mut().enumerate() {
        finish(page, options, k + 1, count);
    }
    Ok(Sheets {
        pages,
        targets,
        bars,
        least_distance: least_distance(options.family, &printed),
        scale,
        scale_sigma: if measured { options.measured_sigma / RULER_MM } else { 0.0 },
        diameter: options.diameter * (across + down) / 2.0,
    })
}

/// Radius of a target with its clear ground, in radii of the dot.
fn outer(design: Option<Design>) -> f64 {
    design.map_or(1.0, |design| design.ring()[1]) + CLEAR
}

/// The cells that a sheet has room for.
fn grid(options: &SheetOptions, half: f64) -> Result<Grid> {
    let [width, height] = options.paper.size();
    let label = if options.labels { LABEL } else { 0.0 };
    let pitch = [2.0 * half + GAP, 2.0 * half + GAP + label];
    let room = [width - EDGES[0] - EDGES[2], height - EDGES[1] - EDGES[3]];
    // The last cell needs no gap.
    let fit = |k: usize| ((room[k] + GAP) / pitch[k] + 1e-9).floor() as usize;
    let (columns, rows) = (fit(0), fit(1));
    if columns * rows == 0 {
        let reason =
            ReportReason::SheetNoRoom { value: options.diameter.into(), width: width.into(), height: height.into() }
                .into();
        return Err(Error::Invalid { reason, at: Place::field("diameter") });
    }
    Ok(Grid { columns, rows, pitch, half })
}

impl Grid {
    fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Column and row of every cell, row by row.
    fn cells(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let (columns, rows) = (self.columns, self.rows);
        (0..rows).flat_map(move |row| (0..columns).map(move |column| [column, row]))
    }

    /// Centre of a cell's target.
    fn at(&self, [column, row]: [usize; 2]) -> [f64; 2] {
        [EDGES[0] + self.half + self.pitch[0] * column as f64, EDGES[1] + self.half + self.pitch[1] * row as f64]
    }
}

/// Whether a cell of a calibration field is a code: in every row another column begins.
fn is_code([column, row]: [usize; 2]) -> bool {
    (column + row).is_multiple_of(CODE_EVERY)
}

impl Draft<'_> {
    fn begin(&mut self, title: String) {
        self.pages.push(Page { size: self.options.paper.size(), title, shapes: Vec::new() });
    }

    /// Draws a target with its ground, its label and its marks.
    fn target(&mut self, at: [f64; 2], half: f64, number: Option<u32>, kind: TargetKind, plate: Option<[f64; 2]>) {
        let options = self.options;
        let id = match number {
            Some(number) => number.to_string(),
            None => {
                self.next_dot += 1;
                format!("d{}", self.next_dot - 1)
            }
        };
        let sheet = self.pages.len();
        let Some(page) = self.pages.last_mut() else { return };
        let (ink, ground) = match options.ground {
            Ground::Paper => (0.0, 1.0),
            Ground::Retro => (1.0, 0.0),
        };
        if options.ground == Ground::Retro {
            page.shapes.push(Shape::Rect { at: at.map(|x| x - half), size: [2.0 * half; 2], grey: ground });
        }
        draw(page, options, at, number, [ink, ground]);
        if options.cut_marks {
            cut_marks(page, at, half);
        }
        if options.labels {
            let size = LABEL_SIZE.min(half * 0.5);
            let family = number.map(|_| format!("  {}", short_name(options.family))).unwrap_or_default();
            let place = [at[0] - half + 0.5, at[1] + half + 0.9 + size * 0.75];
            page.text(place, size, format!("{id}{family}  \u{d8}{}", trimmed(options.diameter)));
        }
        self.targets.push(Printed { id, kind, number, sheet, at, plate });
    }

    /// Pairs whose distance the sheet has room for stand on it at that distance; others are cut out, end by end.
    fn bars(&mut self, codes: &Grid, ends: &[u32]) -> Vec<BarEnds> {
        let options = self.options;
        let [width, height] = options.paper.size();
        let room = [width - EDGES[0] - EDGES[2] - 2.0 * codes.half, height - EDGES[1] - EDGES[3] - codes.pitch[1]];
        let length = options.bar_length;
        let across = length <= room[0] && length >= 2.0 * codes.half;
        let down = !across && length <= room[1] && length >= codes.pitch[1];
        let mut bars = Vec::new();
        if !across && !down {
            for part in ends.chunks(codes.count() / 2 * 2) {
                if part.is_empty() || codes.count() < 2 {
                    break;
                }
                self.begin(self.words.bar_ends(&trimmed(length)));
                for (cell, number) in codes.cells().zip(part) {
                    self.target(codes.at(cell), codes.half, Some(*number), TargetKind::BarEnd, None);
                }
            }
            // A sheet with room for a single target has one end.
            if codes.count() < 2 {
                for number in ends {
                    self.begin(self.words.bar_end(&trimmed(length)));
                    self.target(codes.at([0, 0]), codes.half, Some(*number), TargetKind::BarEnd, None);
                }
            }
            bars.extend(ends.chunks_exact(2).map(|pair| BarEnds {
                from: pair[0].to_string(),
                to: pair[1].to_string(),
                length,
                sigma: None,
            }));
            return bars;
        }
        let side = usize::from(down);
        let lanes = if across { codes.rows } else { codes.columns };
        let scale = self.scale[side];
        let relative =
            length * options.measured.or(options.measured_down).map_or(0.0, |_| options.measured_sigma / RULER_MM);
        for part in ends.chunks(2 * lanes) {
            self.begin(self.words.bars(&trimmed(length)));
            for (lane, pair) in part.chunks_exact(2).enumerate() {
                let cell = if across { [0, lane] } else { [lane, 0] };
                let from = codes.at(cell);
                let mut to = from;
                to[side] += length;
                for (at, number) in [(from, pair[0]), (to, pair[1])] {
                    self.target(at, codes.half, Some(number), TargetKind::BarEnd, None);
                }
                bars.push(BarEnds {
                    from: pair[0].to_string(),
                    to: pair[1].to_string(),
                    length: length * scale,
                    sigma: Some(relative.hypot(PRINTED_MM)),
                });
            }
        }
        bars
    }

    /// Plain dots.
    fn dots(&mut self) -> Result<()> {
        let options = self.options;
        let count = options.dots as usize;
        if count == 0 {
            return Ok(());
        }
        let half = outer(None) * options.diameter / 2.0;
        // Jittered dots have cells half as wide again, to have somewhere to go.
        let jittered = options.pattern == Pattern::Jittered;
        let room = if jittered { 1.5 } else { 1.0 };
        let cells = grid(options, half * room)?;
        let mut noise = Noise::new(options.seed, 0);
        let mut left = count;
        while left > 0 {
            let last = self.next_dot as usize + left.min(cells.count()) - 1;
            self.begin(self.words.dots(self.next_dot as usize, last));
            for cell in cells.cells().take(left) {
                let mut at = cells.at(cell);
                if jittered {
                    let most = JITTER * (cells.half - half);
                    // Normal numbers, folded into the room there is.
                    at.iter_mut().for_each(|x| *x += most * (noise.normal() * 1.2).sin());
                }
                self.target(at, half, None, TargetKind::Dot, None);
            }
            left -= left.min(cells.count());
        }
        Ok(())
    }

    /// A plate: codes and dots in turn on every sheet, sheets edge to edge.
    fn field(&mut self, codes: &Grid, numbers: &[u32]) {
        let Some(field) = self.options.field else { return };
        let [width, height] = self.options.paper.size();
        let mut numbers = numbers.iter().copied();
        for row in 0..field.rows {
            for column in 0..field.columns {
                self.begin(self.words.field(column + 1, row + 1));
                for cell in codes.cells() {
                    let at = codes.at(cell);
                    // A print keeps the sheet's middle; the scale works from there.
                    let own = [
                        width / 2.0 + (at[0] - width / 2.0) * self.scale[0],
                        height / 2.0 - (at[1] - height / 2.0) * self.scale[1],
                    ];
                    let plate = [own[0] + width * f64::from(column), own[1] + height * f64::from(field.rows - 1 - row)];
                    let number = if is_code(cell) { numbers.next() } else { None };
                    let kind = if number.is_some() { TargetKind::Code } else { TargetKind::Dot };
                    self.target(at, codes.half, number, kind, Some(plate));
                }
            }
        }
    }
}

/// The dot with its ring. Set sectors beside each other are one shape: a seam between two would be seen.
fn draw(page: &mut Page, options: &SheetOptions, at: [f64; 2], number: Option<u32>, [ink, ground]: [f64; 2]) {
    let radius = options.diameter / 2.0;
    page.shapes.push(Shape::Disc { at, radius, grey: ink });
    let Some(number) = number else { return };
    let design = options.family.design();
    let (bits, code) = (options.family.bits(), options.family.codes()[number as usize - 1]);
    let radii = design.ring().map(|r| r * radius);
    // Most significant bit first, clockwise.
    let set = |k: u32| code >> (bits - 1 - k % bits) & 1 == 1;
    for start in (0..bits).filter(|k| set(*k) && !set(*k + bits - 1)) {
        let length = (0..bits).take_while(|k| set(start + k)).count() as u32;
        let turns = [start, start + length].map(|k| f64::from(k) / f64::from(bits));
        page.shapes.push(Shape::Sector { at, radii, turns, grey: ink });
    }
    if design.spot() > 0.0 {
        page.shapes.push(Shape::Disc { at, radius: design.spot() * radius, grey: ground });
    }
}

/// Two short lines at each corner of a square, outside of it.
fn cut_marks(page: &mut Page, at: [f64; 2], half: f64) {
    let [length, off, width] = CUT;
    for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        let corner = [at[0] + sx * half, at[1] + sy * half];
        let (near, far) = (off, off + length.min(GAP / 2.0 - off));
        page.line([corner[0] + sx * near, corner[1]], [corner[0] + sx * far, corner[1]], width);
        page.line([corner[0], corner[1] + sy * near], [corner[0], corner[1] + sy * far], width);
    }
}

/// Heading and rulers.
fn finish(page: &mut Page, options: &SheetOptions, number: usize, count: usize) {
    let [width, height] = page.size;
    let dots = format!("\u{d8} {} mm", trimmed(options.diameter));
    let title = if options.title.is_empty() { String::new() } else { format!("{} \u{b7} ", options.title) };
    let words = Words(options.language);
    let heading = format!("{title}{} \u{b7} {dots} \u{b7} {}", page.title, words.sheet(number, count));
    page.text([EDGES[0], 11.0], 2.8, heading);
    page.text([width - 58.0, 15.5], 2.8, words.print());
    let left = EDGES[0];
    let base = height - 12.0;
    ruler(page, [left, base], [1.0, 0.0]);
    page.text([left + RULER_MM + 5.0, base - 0.5], 2.4, words.ruler());
    ruler(page, [width - 10.0, height - 22.0 - RULER_MM], [0.0, 1.0]);
}

/// A ruler of [`RULER_MM`] from a place along a direction, with a mark every millimetre.
fn ruler(page: &mut Page, from: [f64; 2], along: [f64; 2]) {
    // To the left of the direction as it is seen, where the marks stand.
    let beside = [along[1], -along[0]];
    let place =
        |s: f64, off: f64| [from[0] + s * along[0] - off * beside[0].abs(), from[1] + s * along[1] + off * beside[1]];
    page.line(place(0.0, 0.0), place(RULER_MM, 0.0), 0.15);
    for k in 0..=RULER_MM as u32 {
        let length = match k {
            k if k.is_multiple_of(10) => 4.0,
            k if k.is_multiple_of(5) => 3.0,
            _ => 2.0,
        };
        page.line(place(f64::from(k), 0.0), place(f64::from(k), length), 0.12);
        if k.is_multiple_of(10) {
            let across = along[0] > 0.0;
            let at = if across {
                [from[0] + f64::from(k), from[1] + 3.4]
            } else {
                [from[0] + 4.0, from[1] + f64::from(k) + 0.9]
            };
            page.digits(at, 2.4, k);
        }
    }
}

/// The family as its makers call it.
fn family_name(family: Family) -> String {
    let maker = match family.design() {
        Design::Schneider => "Schneider / AICON",
        Design::Metashape => "Metashape circular",
    };
    format!("{maker} {} bit", family.bits())
}

fn short_name(family: Family) -> String {
    let letter = match family.design() {
        Design::Schneider => 'R',
        Design::Metashape => 'M',
    };
    format!("{letter}{}", family.bits())
}

/// A length without needless digits.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
