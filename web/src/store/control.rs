//! Control points, scale and datum: what ties the object to the world.

use leptos::prelude::*;
use sightline::Error;
use sightline::error::Lack;
use sightline::exchange::control_csv::{self, ControlTable};
use sightline::project::{DatumKind, Distance, Point, Role};

use super::document::Change;
use super::{Desk, Step};
use crate::format;
use crate::i18n::text;

/// Control points that were pasted or opened, waiting to be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    pub source: String,
    pub table: ControlTable,
}

/// What a distance lacks before it can be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceFault {
    SamePoint,
    NoSuchPoint,
    Length,
    Sigma,
}

impl Desk {
    /// Reads control points and shows what they would become.
    pub fn read_control(self, source: String, content: &str) {
        let table = control_csv::parse(content);
        if table.rows.is_empty() {
            self.warn_error(Error::Empty { what: Lack::Points });
            return;
        }
        self.pasted.set(Some(Pasted { source, table }));
        self.go(Step::Control);
    }

    /// Takes the rows that were understood.
    pub fn take_control(self) {
        let Some(pasted) = self.pasted.get_untracked() else { return };
        let (points, _) = pasted.table.split();
        if points.is_empty() {
            return;
        }
        self.change(Change::ControlTaken(points.len()), |document| {
            let project = document.project_mut();
            for point in points {
                let role = if point.role == Role::Tie { Role::Control } else { point.role };
                match project.points.iter_mut().find(|p| p.id == point.id) {
                    Some(known) => {
                        let diameter = point.diameter.or(known.diameter);
                        let normal = point.normal.or(known.normal);
                        *known = Point { role, diameter, normal, ..point };
                    }
                    None => project.points.push(Point { role, ..point }),
                }
            }
            // Three points fix a system: the control system is then what people expect to stand in.
            let control = project.points.iter().filter(|p| p.role == Role::Control).count();
            if control >= 3 && project.datum.kind == DatumKind::Free && project.datum.points.is_none() {
                project.datum.kind = DatumKind::Control;
            }
        });
        self.pasted.set(None);
    }

    pub fn set_role(self, id: &str, role: Role) {
        self.change(Change::RoleSet(id.to_owned()), |document| {
            if let Some(point) = document.project_mut().points.iter_mut().find(|p| p.id == id) {
                point.role = role;
            }
        });
    }

    /// Adds a measured distance, or says what it lacks.
    pub fn add_distance(self, from: &str, to: &str, length: &str, sigma: &str) -> Result<(), DistanceFault> {
        let (from, to) = (from.trim().to_owned(), to.trim().to_owned());
        let known = |id: &str| self.document.with_untracked(|d| d.project.points.iter().any(|p| p.id == id));
        if !known(&from) || !known(&to) {
            return Err(DistanceFault::NoSuchPoint);
        }
        if from == to {
            return Err(DistanceFault::SamePoint);
        }
        let length = format::parse(length).filter(|l| *l > 0.0).ok_or(DistanceFault::Length)?;
        let sigma = format::parse(sigma).filter(|s| *s > 0.0).ok_or(DistanceFault::Sigma)?;
        self.change(Change::DistanceAdded { from: from.clone(), to: to.clone() }, |document| {
            document.project_mut().distances.push(Distance { from, to, length, sigma });
        });
        Ok(())
    }

    pub fn remove_distance(self, place: usize) {
        let Some(distance) = self.document.with_untracked(|d| d.project.distances.get(place).cloned()) else { return };
        self.change(Change::DistanceRemoved { from: distance.from, to: distance.to }, |document| {
            document.project_mut().distances.remove(place);
        });
    }

    pub fn set_datum(self, kind: DatumKind) {
        self.change(Change::DatumChosen, |document| document.project_mut().datum.kind = kind);
    }

    pub fn set_unit(self, unit: &str) {
        let unit = unit.trim();
        if unit.is_empty() {
            self.document.notify();
            return;
        }
        self.change(Change::UnitSet, |document| document.project_mut().unit = unit.to_owned());
    }
}

/// The sentence for a distance that cannot be taken.
pub fn distance_fault(fault: DistanceFault) -> &'static str {
    match fault {
        DistanceFault::SamePoint => text::distance_same_point(),
        DistanceFault::NoSuchPoint => text::distance_no_point(),
        DistanceFault::Length => text::distance_length(),
        DistanceFault::Sigma => text::distance_sigma(),
    }
}
