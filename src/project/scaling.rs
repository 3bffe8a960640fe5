//! A project in another unit: every length multiplied by one factor.
//!
//! Lengths are object coordinates, their standard errors, diameters, distances, projection centres, given coordinates of features
//! and coordinate systems, the standard error of a rig's positions, the permitted length error, and the lengths of the plan. Image coordinates, interior orientations, angles, normals
//! and ratios stay. Each type is taken apart field by field, so that a new field does not compile until it is handled.

use super::{
    CoordinateSystem, Distance, Feature, FeatureKind, Form, GivenPoint, LengthLimit, Lens, Photo, Plan, PlanDistance,
    PlanFace, PlanStation, Point, Project, Region, ReportSettings, Rig, SystemKind, Variant, Wanted,
    validation::LARGEST,
};
use crate::error::{Error, Place, Reason, Result};

/// A length times a factor. A factor that is one over a whole number divides by it, which rounds once: 565 mm are 0.565 m.
///
/// # Errors
/// [`Error::Invalid`] if the product is beyond what a document holds, or a length other than 0 would become 0.
pub fn scaled(length: f64, factor: f64) -> Result<f64> {
    let whole = factor.recip().round();
    let product = if factor < 1.0 && whole.recip() == factor { length / whole } else { length * factor };
    if product.abs() < LARGEST && (length == 0.0 || product.is_normal()) {
        return Ok(product);
    }
    let reason = Reason::Scaled { value: length.into(), factor: factor.into() };
    Err(Error::Invalid { reason, at: Place::default() })
}

impl Project {
    /// The project with every length multiplied by `factor`; the unit's name stays.
    ///
    /// # Errors
    /// As [`scaled`], with the place; then nothing is converted.
    pub fn scaled(&self, factor: f64) -> Result<Self> {
        let mut project = self.clone();
        let mut scale = Scale { factor, fault: None, at: Place::default() };
        scale.project(&mut project);
        match scale.fault {
            Some(fault) => Err(fault),
            None => Ok(project),
        }
    }

    /// Whether any length is in the project, given or computed: the unit is then more than the one it began with.
    pub fn holds_lengths(&self) -> bool {
        self.scaled(2.0).is_ok_and(|twice| {
            // the plan's unit is no length
            let without_unit = |mut project: Self| {
                if let Some(plan) = &mut project.plan {
                    plan.lens.unit_mm = 1.0;
                }
                project
            };
            without_unit(twice) != without_unit(self.clone())
        })
    }
}

struct Scale {
    factor: f64,
    fault: Option<Error>,
    at: Place,
}

impl Scale {
    fn length(&mut self, length: &mut f64) {
        match scaled(*length, self.factor) {
            Ok(product) => *length = product,
            Err(Error::Invalid { reason, .. }) => {
                self.fault.get_or_insert(Error::Invalid { reason, at: self.at.clone() });
            }
            Err(other) => {
                self.fault.get_or_insert(other);
            }
        }
    }

    fn lengths<'a>(&mut self, lengths: impl IntoIterator<Item = &'a mut f64>) {
        lengths.into_iter().for_each(|length| self.length(length));
    }

    fn project(&mut self, project: &mut Project) {
        let Project {
            format: _,
            version: _,
            name: _,
            unit: _,
            axes: _,
            cameras: _,
            photos,
            points,
            observations: _,
            distances,
            datum: _,
            rig,
            set_aside: _,
            features,
            systems,
            lines: _,
            layers: _,
            report,
            plan,
            epoch: _,
            origin: _,
        } = project;
        photos.iter_mut().for_each(|photo| self.photo(photo));
        points.iter_mut().for_each(|point| self.point(point));
        for distance in distances {
            let Distance { from, to: _, length, sigma, check: _ } = distance;
            self.at = Place::point(from.as_str()).with_field("distances");
            self.lengths([length, sigma]);
        }
        if let Some(rig) = rig {
            let Rig { exposures: _, sigma_position, sigma_rotation: _ } = rig.as_mut();
            self.at = Place::field("rig.sigma_position");
            self.length(sigma_position);
        }
        features.iter_mut().for_each(|feature| self.feature(feature));
        systems.iter_mut().for_each(|system| self.system(system));
        self.at = Place::field("report.length_limit");
        self.report(report);
        self.at = Place::field("plan");
        plan.iter_mut().for_each(|plan| self.plan(plan));
    }

    fn photo(&mut self, photo: &mut Photo) {
        let Photo {
            id,
            camera: _,
            file: _,
            position,
            rotation: _,
            sigma_position,
            // In the unit of the sensor: pixels or millimetres.
            interior: _,
            enabled: _,
            sha256: _,
        } = photo;
        self.at = Place::photo(id.as_str()).with_field("position");
        self.lengths(position.iter_mut().flatten());
        self.lengths(sigma_position.iter_mut().flatten().flatten());
    }

    fn point(&mut self, point: &mut Point) {
        let Point { id, role: _, xyz, sigma, diameter, normal: _ } = point;
        self.at = Place::point(id.as_str());
        self.lengths(xyz.iter_mut().flatten());
        self.lengths(sigma.iter_mut().flatten().flatten());
        self.lengths(diameter);
    }

    fn feature(&mut self, feature: &mut Feature) {
        let Feature { id, kind } = feature;
        self.at = Place::field(format!("features: {id}"));
        match kind {
            FeatureKind::Deviations { points: _, feature: _, given } => {
                given.iter_mut().for_each(|given| self.given(given));
            }
            FeatureKind::Line { .. }
            | FeatureKind::Plane { .. }
            | FeatureKind::Circle { .. }
            | FeatureKind::Sphere { .. }
            | FeatureKind::Cylinder { .. }
            | FeatureKind::Distance { .. }
            | FeatureKind::Angle { .. } => {}
        }
    }

    fn system(&mut self, system: &mut CoordinateSystem) {
        let CoordinateSystem { id, kind } = system;
        self.at = Place::field(format!("systems: {id}"));
        match kind {
            SystemKind::BestFit { given, scale: _ } => given.iter_mut().for_each(|given| self.given(given)),
            SystemKind::Automatic { .. } | SystemKind::PlaneLinePoint { .. } => {}
        }
    }

    fn given(&mut self, given: &mut GivenPoint) {
        let GivenPoint { id: _, xyz, sigma } = given;
        self.lengths(xyz);
        self.lengths(sigma.iter_mut().flatten());
    }

    fn report(&mut self, report: &mut ReportSettings) {
        // `per` is a ratio of lengths.
        if let Some(LengthLimit { constant, per: _ }) = &mut report.length_limit {
            self.length(constant);
        }
    }

    fn plan(&mut self, plan: &mut Plan) {
        let Plan {
            cameras: _,
            lens: Lens { f_number: _, focus, circle_px: _, unit_mm },
            form,
            points,
            faces,
            distances,
            datum: _,
            stations,
            variants,
            forbidden,
            sigma: _,
            max_incidence: _,
            margin: _,
            least_px: _,
            wanted: Wanted { precision, probability: _ },
        } = plan;
        self.lengths(focus);
        // Millimetres in a unit: as much larger as the numbers become smaller.
        match scaled(*unit_mm, self.factor.recip()) {
            Ok(converted) => *unit_mm = converted,
            Err(fault) => {
                self.fault.get_or_insert(fault);
            }
        }
        self.length(precision);
        match form {
            Some(Form::Plane { width, height, columns: _, rows: _, upright: _, diameter }) => {
                self.lengths([width, height, diameter]);
            }
            Some(Form::Box { size, columns: _, rows: _, diameter }) => {
                self.lengths(size);
                self.length(diameter);
            }
            Some(Form::Cylinder { radius, height, sweep: _, columns: _, rows: _, inside: _, diameter }) => {
                self.lengths([radius, height, diameter]);
            }
            None => {}
        }
        points.iter_mut().for_each(|point| self.point(point));
        self.at = Place::field("plan");
        for PlanFace { corner, along, across } in faces {
            self.lengths(corner.iter_mut().chain(along).chain(across));
        }
        for PlanDistance { from: _, to: _, sigma } in distances {
            self.length(sigma);
        }
        stations.iter_mut().for_each(|station| self.station(station));
        for Variant { name: _, stations } in variants {
            stations.iter_mut().for_each(|station| self.station(station));
        }
        for Region { low, high } in forbidden {
            self.lengths(low.iter_mut().chain(high));
        }
    }

    fn station(&mut self, station: &mut PlanStation) {
        let PlanStation { id: _, camera: _, position, look_at, rotation: _, roll: _, taken: _ } = station;
        self.lengths(position);
        self.lengths(look_at.iter_mut().flatten());
    }
}
