//! Sheets of targets to print: codes, plain dots, ends of scale bars and calibration fields, true to scale, as PDF and SVG.
//!
//! A target is a dot, its code ring where it has one, and ground of one radius of the dot all around that nothing else stands
//! in. Codes are offered in the order of [`sightline::ring_code::spread`]: those with the largest mutual distance first, so that
//! one with sectors hidden cannot pass for another. Every sheet has a ruler across and one down; what they measure on paper is the
//! scale of the print, which goes into all diameters and distances that are printed.
//!
//! Places on a sheet are millimetres from its top left corner, x right, y down.

mod advice;
mod codes;
pub mod drawing;
mod layout;
mod lists;
mod pdf;
mod svg;
mod words;

use crate::reason::ReportReason;
use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Reason, Result};
use sightline::project::ReportLanguage;
use sightline::ring_code::Family;

pub use advice::{AdviceOptions, Advised, BEST_PX, LEAST_PX, advice};
pub use codes::{CodeCount, counts};
use drawing::Page;

/// Length of the rulers, mm.
pub const RULER_MM: f64 = 100.0;
/// Ground around a target that stays clear, in radii of the dot.
pub const CLEAR: f64 = 1.0;

/// Size of the paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Paper {
    /// 210 x 297 mm.
    #[default]
    A4,
    /// 297 x 420 mm.
    A3,
    /// 8.5 x 11 inches.
    Letter,
}

impl Paper {
    /// Width and height in mm.
    pub fn size(self) -> [f64; 2] {
        match self {
            Self::A4 => [210.0, 297.0],
            Self::A3 => [297.0, 420.0],
            Self::Letter => [215.9, 279.4],
        }
    }
}

/// Background of the targets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ground {
    /// Black on white paper.
    #[default]
    Paper,
    /// White on black: a print on retro-reflecting foil, or dots that ink would gloss.
    Retro,
}

/// How plain dots stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// In rows and columns.
    #[default]
    Regular,
    /// Each moved at random from its place in the grid, so that no part of a sheet looks like another.
    Jittered,
}

/// A plate with codes and dots over several sheets, mounted edge to edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Field {
    /// Sheets beside each other.
    pub columns: u32,
    /// Sheets above each other.
    pub rows: u32,
}

impl Default for Field {
    fn default() -> Self {
        Self { columns: 1, rows: 1 }
    }
}

/// Options of printed sheets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SheetOptions {
    /// Stands at the top of every sheet.
    pub title: String,
    /// Language of what is written on the sheets.
    pub language: ReportLanguage,
    /// Size of the paper.
    pub paper: Paper,
    /// Family of the codes.
    pub family: Family,
    /// Numbers of the codes, as "1-20, 35"; empty: the first `codes` of those with the largest mutual distance.
    pub numbers: String,
    /// How many codes, where `numbers` names none.
    pub codes: u32,
    /// Diameter of the dots, mm.
    pub diameter: f64,
    /// Ground of the targets.
    pub ground: Ground,
    /// Plain dots.
    pub dots: u32,
    /// How they stand.
    pub pattern: Pattern,
    /// Pairs of codes that are ends of scale bars. Their numbers follow those of the codes.
    pub bars: u32,
    /// Distance of the ends of a pair, mm. A distance that the paper has room for is printed.
    pub bar_length: f64,
    /// A calibration field.
    pub field: Option<Field>,
    /// Marks to cut along.
    pub cut_marks: bool,
    /// Number and family in small print, outside of the ground that stays clear.
    pub labels: bool,
    /// Measured length of the horizontal ruler on the print, mm.
    pub measured: Option<f64>,
    /// Measured length of the vertical ruler on the print, mm; `None`: equal to that of the horizontal one.
    pub measured_down: Option<f64>,
    /// Standard error of these readings, mm.
    pub measured_sigma: f64,
    /// Seed of jittered dots.
    pub seed: u64,
}

impl Default for SheetOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            language: ReportLanguage::default(),
            paper: Paper::default(),
            family: Family::Ring14,
            numbers: String::new(),
            codes: 20,
            diameter: 10.0,
            ground: Ground::default(),
            dots: 0,
            pattern: Pattern::default(),
            bars: 0,
            bar_length: 1000.0,
            field: None,
            cut_marks: true,
            labels: true,
            measured: None,
            measured_down: None,
            measured_sigma: 0.1,
            seed: 1,
        }
    }
}

/// Kind of a printed target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TargetKind {
    /// A code.
    Code,
    /// A plain dot.
    Dot,
    /// A code that is an end of a scale bar.
    BarEnd,
}

/// A target on a sheet, as it is drawn: the scale of the print is not in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Printed {
    /// Identifier: the code's number, or "d" and a number for plain dots.
    pub id: String,
    /// What it is.
    pub kind: TargetKind,
    /// Number of the code; null for plain dots.
    pub number: Option<u32>,
    /// Sheet, counted from 1.
    pub sheet: usize,
    /// Centre on the sheet, mm.
    pub at: [f64; 2],
    /// Nominal coordinates on the plate of a calibration field in mm, X right, Y up, with the scale of the print; null elsewhere.
    pub plate: Option<[f64; 2]>,
}

/// A pair of ends of a scale bar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BarEnds {
    /// One end.
    pub from: String,
    /// The other end.
    pub to: String,
    /// Their distance in mm: with the scale of the print where both are on one sheet, as it was asked for elsewhere.
    pub length: f64,
    /// Standard error of a printed distance, mm; null if the ends are mounted by hand and the distance is to be measured.
    pub sigma: Option<f64>,
}

/// Sheets, ready to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheets {
    /// The sheets.
    pub pages: Vec<Page>,
    /// Contents in the order of the sheets.
    pub targets: Vec<Printed>,
    /// Scale bars.
    pub bars: Vec<BarEnds>,
    /// Smallest mutual distance of the codes on them; null with fewer than two.
    pub least_distance: Option<u32>,
    /// Scale of the print across and down, 1 until a ruler is measured.
    pub scale: [f64; 2],
    /// Its standard error.
    pub scale_sigma: f64,
    /// Diameter of the dots on paper, mm.
    pub diameter: f64,
}

/// Draws the sheets.
///
/// # Errors
/// [`Error::Invalid`] with the field's name: a number that the family has not, a diameter that the paper has no room for, more than
/// [`limits::SHEETS`](sightline::limits::SHEETS), a ruler that measures nothing like its length.
pub fn target_sheets(options: &SheetOptions) -> Result<Sheets> {
    check(options)?;
    layout::sheets(options)
}

impl Sheets {
    /// All sheets as one PDF.
    pub fn pdf(&self) -> Vec<u8> {
        pdf::pdf(&self.pages)
    }

    /// A sheet as SVG, counted from 0.
    pub fn svg(&self, page: usize) -> Option<String> {
        self.pages.get(page).map(svg::svg)
    }

    /// A small picture of a sheet with its targets alone, as SVG, counted from 0.
    pub fn sketch(&self, page: usize) -> Option<String> {
        self.pages.get(page).map(svg::sketch)
    }

    /// Files that go with the print: diameters, distances and the coordinates of a calibration field, as far as there are any.
    pub fn files(&self) -> Vec<(String, Vec<u8>)> {
        lists::files(self)
    }
}

fn check(options: &SheetOptions) -> Result<()> {
    let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
    if !(0.5..=400.0).contains(&options.diameter) {
        return invalid(ReportReason::SheetDiameter { value: options.diameter.into() }.into(), "diameter");
    }
    for (value, field) in [(options.measured, "measured"), (options.measured_down, "measured_down")] {
        if value.is_some_and(|value| !(0.5 * RULER_MM..=2.0 * RULER_MM).contains(&value)) {
            let value = value.unwrap_or_default().into();
            return invalid(ReportReason::SheetRuler { value, length: RULER_MM.into() }.into(), field);
        }
    }
    if !(options.measured_sigma >= 0.0 && options.measured_sigma <= RULER_MM) {
        return invalid(Reason::NegativeSigma, "measured_sigma");
    }
    if !(options.bar_length > 0.0 && options.bar_length <= 1e6) {
        return invalid(ReportReason::SheetBar { value: options.bar_length.into() }.into(), "bar_length");
    }
    Ok(())
}

#[cfg(test)]
mod tests;
