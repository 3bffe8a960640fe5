//! Shared data of the sections: document, result, words, and the number of digits for each kind of number.

use std::collections::{HashMap, HashSet};

use super::names;
use super::number::{decimals_for, fixed, maybe};
use super::texts::{Words, words};
use sightline::adjustment::{AdjustedObservation, Adjustment, Given};
use sightline::axes::ShownAxes;
use sightline::plausibility::scale;
use sightline::project::{Camera, Point, Project, ReportLanguage, ReportSettings, Role};

/// Data for all sections.
pub struct Context<'a> {
    pub project: &'a Project,
    pub adjustment: &'a Adjustment,
    pub words: &'static dyn Words,
    pub language: ReportLanguage,
    /// Of lengths in the object; states that there is none if nothing gives a scale.
    pub unit: &'a str,
    /// Whether anything gives a scale.
    pub scaled: bool,
    /// Letters and order of coordinates.
    pub axes: ShownAxes,
    /// Decimals of object coordinates: two digits of the smallest mean standard error.
    pub decimals: usize,
    /// Unit of residuals.
    pub residual_unit: &'static str,
    /// Factors from a photo's residuals to it.
    factors: HashMap<String, [f64; 2]>,
    photos: HashMap<&'a str, usize>,
}

impl<'a> Context<'a> {
    pub fn new(project: &'a Project, adjustment: &'a Adjustment) -> Self {
        let language = project.report.language.unwrap_or_default();
        let is_distance = |what: &Given| matches!(what, Given::Distance { .. });
        let distances = adjustment.given.iter().filter(|given| given.enabled && is_distance(&given.what)).count();
        let scaled = scale::is_given(project, distances);
        let typical = adjustment.precision.as_ref().map_or(0.001, |p| smallest(&p.rms_sigma));
        Self {
            project,
            adjustment,
            words: words(language),
            language,
            unit: if scaled { project.unit.as_str() } else { words(language).no_unit() },
            scaled,
            axes: project.shown_axes(),
            decimals: decimals_for(typical),
            residual_unit: names::common_unit(adjustment).1,
            factors: names::factors(adjustment),
            photos: project.photos.iter().enumerate().map(|(k, photo)| (photo.id.as_str(), k)).collect(),
        }
    }

    pub fn settings(&self) -> &'a ReportSettings {
        &self.project.report
    }

    pub fn language_tag(&self) -> &'static str {
        match self.language {
            ReportLanguage::English => "en",
            ReportLanguage::Korean => "ko",
        }
    }

    /// Of the report: its own, the project's name, or what it is.
    pub fn title(&self) -> &'a str {
        let given = [self.settings().title.as_str(), self.project.name.as_str()].map(str::trim);
        given.into_iter().find(|title| !title.is_empty()).unwrap_or_else(|| self.words.report_title())
    }

    /// A coordinate or its standard error.
    pub fn length(&self, value: f64) -> String {
        fixed(value, self.decimals)
    }

    /// The same with its unit.
    pub fn with_unit(&self, value: f64) -> String {
        self.in_unit(&self.length(value))
    }

    /// A length in words with its unit, if it has one.
    pub fn in_unit(&self, length: &str) -> String {
        if self.scaled { format!("{length} {}", self.unit) } else { length.to_owned() }
    }

    pub fn maybe_length(&self, value: Option<f64>) -> String {
        maybe(value, self.decimals)
    }

    /// Factors from a photo's residuals to the report's unit of residuals.
    pub fn residual_factors(&self, photo: &str) -> [f64; 2] {
        self.factors.get(photo).copied().unwrap_or([1.0; 2])
    }

    /// Decimals of residuals.
    pub fn residual_decimals(&self, photo: &str) -> usize {
        2 + usize::from(self.residual_factors(photo)[0] < 100.0)
    }

    /// The camera of a photo.
    pub fn camera_of(&self, photo: &str) -> Option<&'a Camera> {
        let photo = &self.project.photos[*self.photos.get(photo)?];
        self.project.cameras.iter().find(|camera| camera.id == photo.camera)
    }

    /// Name of a photo: its identifier, and its file name if that adds information.
    pub fn file_of(&self, photo: &str) -> &'a str {
        self.photos.get(photo).map_or("", |k| self.project.photos[*k].file.as_str())
    }

    pub fn role(&self, role: Role) -> &'static str {
        match role {
            Role::Tie => self.words.role_tie(),
            Role::Control => self.words.role_control(),
            Role::Check => self.words.role_check(),
        }
    }

    /// Control points that took part.
    pub fn used_control(&self) -> impl Iterator<Item = &'a Point> {
        let adjusted: HashSet<&str> = self.adjustment.points.iter().map(|point| point.id.as_str()).collect();
        let control = self.project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some());
        control.filter(move |p| adjusted.contains(p.id.as_str()))
    }

    /// The observation, by name.
    pub fn given_name(&self, what: &Given) -> String {
        let axis = |axis: usize| self.axes.letter(axis);
        match what {
            Given::Control { point: id, axis: a } | Given::Position { photo: id, axis: a } => {
                format!("{id} {}", axis(*a))
            }
            Given::Distance { from, to } => format!("{from} – {to}"),
            Given::Parameter { camera, photo, parameter } => {
                let photo = photo.as_ref().map(|photo| format!(" · {photo}")).unwrap_or_default();
                format!("{camera}{photo} {}", names::parameter_name(*parameter))
            }
        }
    }

    /// Its kind in words.
    pub fn given_kind(&self, what: &Given) -> &'static str {
        match what {
            Given::Control { .. } => self.words.control_coordinate(),
            Given::Position { .. } => self.words.projection_centre(),
            Given::Distance { .. } => self.words.distance(),
            Given::Parameter { .. } => self.words.camera_parameter(),
        }
    }

    /// Standard deviation of a coordinate, over all points and axes; `None` without statistics.
    pub fn mean_sigma(&self) -> Option<f64> {
        let rms = self.adjustment.precision.as_ref()?.rms_sigma;
        Some((rms.iter().map(|s| s * s).sum::<f64>() / 3.0).sqrt()).filter(|s| *s > 0.0)
    }

    /// The least certain coordinate: point, axis and standard error.
    pub fn weakest(&self) -> Option<(&'a str, usize, f64)> {
        let all = self.adjustment.points.iter().filter_map(|p| Some((p, p.sigma?)));
        let each = all.flat_map(|(p, sigma)| (0..3).map(move |k| (p.id.as_str(), k, sigma[k])));
        each.max_by(|a, b| a.2.total_cmp(&b.2))
    }
}

/// The smallest of some numbers.
pub fn smallest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The larger |w| of an observation's two coordinates.
pub fn largest_w(o: &AdjustedObservation) -> Option<f64> {
    [o.wx, o.wy].into_iter().flatten().max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Names with commas, and how many more there are.
pub fn listed<'a>(names: impl IntoIterator<Item = &'a str>, most: usize) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    let shown = names.iter().take(most).copied().collect::<Vec<_>>().join(", ");
    if names.len() > most { format!("{shown}, … (+{})", names.len() - most) } else { shown }
}
