//! Scale bars, and the distances they give if their ends are measured.

use std::collections::{HashMap, HashSet};

use serde::{Deserialize, Serialize};

use super::unit_factor;
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Distance, Point, Project};

/// Photos that must show an end for it to have a place.
const RAYS: usize = 2;

/// A scale bar: two targets at a certified distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleBar {
    /// Its name.
    pub id: String,
    /// The point at one end, as its code names it.
    pub from: String,
    /// The point at the other end.
    pub to: String,
    /// Length.
    pub length: f64,
    /// Standard error of the length.
    pub sigma: f64,
    /// Unit of both.
    pub unit: String,
    /// Number and maker of its certificate.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub certificate: String,
    /// When it was certified, as `YYYY-MM-DD`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub date: String,
}

impl ScaleBar {
    /// Its distance in another unit; `None` if the units cannot be brought together.
    pub fn distance(&self, unit: &str) -> Option<Distance> {
        let factor = unit_factor(&self.unit, unit)?;
        let (from, to) = (self.from.clone(), self.to.clone());
        Some(Distance { from, to, length: factor * self.length, sigma: factor * self.sigma, check: false })
    }

    /// Checks that a project would take its distance.
    ///
    /// # Errors
    /// [`Error::Invalid`], which names the bar by its field.
    pub fn validate(&self) -> Result<()> {
        let at = || Place::field(format!("bars: {}", self.id));
        if self.id.trim().is_empty() || self.unit.trim().is_empty() || self.from.is_empty() || self.to.is_empty() {
            return Err(Error::Invalid { reason: Reason::BarIncomplete, at: at() });
        }
        if self.from == self.to {
            return Err(Error::Invalid { reason: Reason::DistanceEnds, at: at() });
        }
        let distance = self.distance(&self.unit);
        let point = |id: &String| Point { id: id.clone(), ..Point::default() };
        let project = Project {
            points: vec![point(&self.from), point(&self.to)].into(),
            distances: distance.into_iter().collect(),
            ..Project::default()
        };
        project.validate().map_err(|error| match error {
            Error::Invalid { reason, .. } => Error::Invalid { reason, at: at() },
            other => other,
        })
    }
}

/// The bars whose two ends are each measured in two photos that take part, and between which the project has no distance yet;
/// with their distances in the project's unit. A bar in a unit that cannot be brought to it is left out.
pub fn bars_in<'a>(bars: &'a [ScaleBar], project: &Project) -> Vec<(&'a ScaleBar, Distance)> {
    let on: HashSet<&str> = project.photos.iter().filter(|p| p.enabled).map(|p| p.id.as_str()).collect();
    let mut rays: HashMap<&str, HashSet<&str>> = HashMap::new();
    for o in project.observations.iter().filter(|o| o.enabled && on.contains(o.photo.as_str())) {
        rays.entry(&o.point).or_default().insert(&o.photo);
    }
    let seen = |id: &String| rays.get(id.as_str()).is_some_and(|photos| photos.len() >= RAYS);
    let has = |bar: &ScaleBar| {
        let ends = |d: &Distance| (d.from == bar.from && d.to == bar.to) || (d.from == bar.to && d.to == bar.from);
        project.distances.iter().any(ends)
    };
    let wanted = bars.iter().filter(|bar| seen(&bar.from) && seen(&bar.to) && !has(bar));
    wanted.filter_map(|bar| Some((bar, bar.distance(&project.unit)?))).collect()
}

/// Whether something of the project has a length already, so that its unit is more than the one it began with.
pub fn has_lengths(project: &Project) -> bool {
    let given = |point: &Point| point.role != crate::project::Role::Tie && point.xyz.is_some();
    !project.distances.is_empty() || project.points.iter().any(given)
}
