//! All features and systems of a document on the points of one adjustment: fitted forms first, then what is between them, then the
//! standard errors of everything in a few solutions.

use std::collections::HashMap;

use nalgebra::{Matrix2, Vector3};

use super::circle::Circle;
use super::cylinder::Cylinder;
use super::deviation::deviation;
use super::form::{Fitted, GeometricForm, Shape};
use super::line::Line;
use super::linear::{Carry, Function, Vector, across, covariance, root, sum};
use super::plane::Plane;
use super::regression::{Regression, best, fit};
use super::relation;
use super::sphere::Sphere;
use super::system;
use crate::adjustment::{AdjustedPhoto, AdjustedPoint, FeatureResidual, Measured, MeasuredFeature, Quantity};
use crate::error::{Error, Place, Reason, Result};
use crate::initial::PrincipalAxes;
use crate::project::{End, Feature, FeatureKind, Project};

/// Standard errors follow from first derivatives. Of a form whose radius has a larger part of itself as its standard error, or whose
/// direction as many radians, the scatter is another one: the radius of a short arc is one over what is measured. In simulations of
/// circles and spheres the stated one is 0.90 of it at 0.08, 0.82 at 0.12.
const LINEAR: f64 = 0.08;

/// Functions whose covariances are asked for at a time: what is carried has three numbers a point for each.
const AT_ONCE: usize = 48;

/// The adjusted points by name.
pub struct Points<'a> {
    pub all: &'a [AdjustedPoint],
    index: HashMap<&'a str, usize>,
}

impl<'a> Points<'a> {
    fn new(all: &'a [AdjustedPoint]) -> Self {
        Self { all, index: all.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect() }
    }

    pub fn number(&self, id: &str) -> Option<usize> {
        self.index.get(id).copied()
    }

    pub fn at(&self, number: usize) -> Vector3<f64> {
        self.all[number].xyz.into()
    }

    /// Numbers of the points that are there, each once, and the names of the others.
    pub fn numbers(&self, ids: &[String]) -> (Vec<usize>, Vec<String>) {
        let (mut numbers, mut missing) = (Vec::new(), Vec::new());
        let mut seen = std::collections::HashSet::new();
        for id in ids.iter().filter(|id| seen.insert(id.as_str())) {
            match self.number(id) {
                Some(number) => numbers.push(number),
                None => missing.push(id.clone()),
            }
        }
        (numbers, missing)
    }
}

/// Which figure a function gives the standard error of.
enum Figure {
    Value,
    Position(usize),
    /// The first of two across the direction.
    Direction,
    SecondDirection,
    Residual(usize),
}

/// A feature on its way: its figures, and the functions whose variances are wanted.
struct Pending {
    measured: MeasuredFeature,
    functions: Vec<(Figure, Function)>,
}

/// Measures all features of the document.
///
/// # Errors
/// Those of `carry`; features that cannot be measured are reported in their own result.
pub fn measure(
    project: &Project,
    points: &[AdjustedPoint],
    photos: &[AdjustedPhoto],
    carry: Carry<'_>,
) -> Result<Measured> {
    let points = Points::new(points);
    let mut fitted: HashMap<&str, Result<Fitted>> = HashMap::new();
    let mut pending: Vec<Pending> = Vec::new();
    // Forms need no other feature; the rest needs forms only.
    for feature in project.features.iter().filter(|f| is_form(&f.kind)) {
        fitted.insert(&feature.id, form(&feature.kind, &points));
    }
    for feature in &project.features {
        pending.push(one(feature, &points, &fitted));
    }
    sigmas(&mut pending, carry)?;
    withhold(&project.features, &mut pending);
    let features = pending.into_iter().map(|p| p.measured).collect();
    let systems = project.systems.iter().map(|s| system::measured(s, &points, photos, &mut *carry));
    Ok(Measured { features, systems: systems.collect::<Result<_>>()? })
}

/// Share of the points' extent (twice the largest distance from their centroid) above which their rms distance from a form is reported: without it a plane through the corners of a box is
/// given out as measured. Flat parts that are bent stay well below.
const MISFIT: f64 = 0.02;

fn is_form(kind: &FeatureKind) -> bool {
    use FeatureKind as K;
    matches!(kind, K::Line { .. } | K::Plane { .. } | K::Circle { .. } | K::Sphere { .. } | K::Cylinder { .. })
}

fn refused(reason: Reason) -> Error {
    Error::Invalid { reason, at: Place::default() }
}

fn one(feature: &Feature, points: &Points, fitted: &HashMap<&str, Result<Fitted>>) -> Pending {
    let measured = MeasuredFeature {
        id: feature.id.clone(),
        kind: feature.kind.name().into(),
        missing: points.numbers(feature.kind.points()).1,
        ..MeasuredFeature::default()
    };
    let mut pending = Pending { measured, functions: Vec::new() };
    let outcome = match (&feature.kind, fitted.get(feature.id.as_str())) {
        (_, Some(Ok(form))) => {
            pending.form(form, points.numbers(feature.kind.points()).0, points);
            Ok(())
        }
        (_, Some(Err(error))) => Err(error.clone()),
        (FeatureKind::Distance { from, to }, _) => pending.distance([from, to], points, fitted),
        (FeatureKind::Angle { from, at, to }, _) => pending.angle([from, to], at.as_ref(), points, fitted),
        (kind, _) => pending.deviations(kind, points, fitted),
    };
    if let Err(error) = outcome {
        pending.functions.clear();
        pending.measured = MeasuredFeature {
            id: feature.id.clone(),
            kind: feature.kind.name().into(),
            missing: pending.measured.missing,
            error: Some(Box::new(error)),
            ..MeasuredFeature::default()
        };
    }
    pending
}

fn end(end: &End, points: &Points, fitted: &HashMap<&str, Result<Fitted>>) -> Result<Fitted> {
    match end {
        End::Point(id) => {
            let number = points.number(id).ok_or_else(|| refused(Reason::FeaturePointMissing { name: id.clone() }))?;
            let position = Vector::of_point(number, points.at(number));
            Ok(Fitted { position, direction: None, radius: None, shape: Shape::Place, residuals: Vec::new() })
        }
        End::Feature(id) => named(id, fitted).cloned(),
    }
}

fn named<'a>(id: &str, fitted: &'a HashMap<&str, Result<Fitted>>) -> Result<&'a Fitted> {
    match fitted.get(id) {
        Some(Ok(form)) => Ok(form),
        Some(Err(_)) => Err(refused(Reason::FeatureBroken { name: id.into() })),
        None => Err(refused(Reason::FeatureNotFitted { name: id.into() })),
    }
}

impl Pending {
    fn figure(&mut self, value: f64, by: Option<Function>, quantity: Quantity) {
        self.measured.value = Some(value);
        self.measured.quantity = Some(quantity);
        self.functions.extend(by.map(|by| (Figure::Value, by)));
    }

    fn form(&mut self, form: &Fitted, numbers: Vec<usize>, points: &Points) {
        self.measured.points = numbers.len();
        self.measured.position = Some(form.position.value.into());
        for axis in 0..3 {
            self.functions.push((Figure::Position(axis), form.position.by[axis].clone()));
        }
        if let Some(direction) = &form.direction {
            self.measured.direction = Some(direction.value.into());
            let [e, f] = across(&direction.value);
            self.functions.push((Figure::Direction, direction.along(&e)));
            self.functions.push((Figure::SecondDirection, direction.along(&f)));
        }
        if let Some((radius, by)) = &form.radius {
            self.figure(2.0 * radius, Some(sum([(2.0, by)])), Quantity::Diameter);
        }
        let named = numbers.iter().zip(&form.residuals);
        let residuals = named.map(|(k, value)| FeatureResidual {
            point: points.all[*k].id.clone(),
            value: *value,
            ..FeatureResidual::default()
        });
        self.measured.residuals = residuals.collect();
        self.summary();
        let middle = numbers.iter().map(|k| points.at(*k)).sum::<Vector3<f64>>() / numbers.len().max(1) as f64;
        let extent = 2.0 * numbers.iter().map(|k| (points.at(*k) - middle).norm()).fold(0.0, f64::max);
        self.measured.misfit = self.measured.rms.map(|rms| rms / extent).filter(|ratio| *ratio > MISFIT);
        if let Some(direction) = form.direction.as_ref().filter(|_| form.shape.is_axis()) {
            let along = numbers.iter().map(|k| (points.at(*k) - form.position.value).dot(&direction.value));
            let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
            let place = |s: f64| (form.position.value + s * direction.value).into();
            self.measured.ends = vec![place(least), place(most)];
        }
    }

    fn summary(&mut self) {
        let all = &self.measured.residuals;
        if all.is_empty() {
            return;
        }
        let squares: f64 = all.iter().map(|r| r.value * r.value).sum();
        let extremes =
            all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), r| (a.min(r.value), b.max(r.value)));
        self.measured.rms = Some((squares / all.len() as f64).sqrt());
        self.measured.range = Some([extremes.0, extremes.1]);
    }

    fn distance(&mut self, ends: [&End; 2], points: &Points, fitted: &HashMap<&str, Result<Fitted>>) -> Result<()> {
        let distance = relation::distance(&end(ends[0], points, fitted)?, &end(ends[1], points, fitted)?);
        self.measured.points = ends.iter().filter(|end| matches!(end, End::Point(_))).count();
        self.measured.ends = distance.ends.map(Into::into).to_vec();
        self.figure(distance.value, distance.by, Quantity::Distance);
        Ok(())
    }

    fn angle(
        &mut self,
        [from, to]: [&End; 2],
        at: Option<&End>,
        points: &Points,
        fitted: &HashMap<&str, Result<Fitted>>,
    ) -> Result<()> {
        let sides = [end(from, points, fitted)?, end(to, points, fitted)?];
        let (value, by) = match at {
            Some(at) => {
                let at = end(at, points, fitted)?;
                let places = [&sides[0], &at, &sides[1]].map(|side| side.position.value.into());
                self.measured.ends = places.to_vec();
                relation::angle_at(&at, &sides[0], &sides[1])?
            }
            None => relation::angle(&sides[0], &sides[1])?,
        };
        self.measured.points =
            [Some(from), at, Some(to)].iter().flatten().filter(|e| matches!(e, End::Point(_))).count();
        self.figure(value, by, Quantity::Angle);
        Ok(())
    }

    fn deviations(
        &mut self,
        kind: &FeatureKind,
        points: &Points,
        fitted: &HashMap<&str, Result<Fitted>>,
    ) -> Result<()> {
        let FeatureKind::Deviations { points: wanted, feature, given } = kind else { return Ok(()) };
        if let Some(feature) = feature {
            let form = named(feature, fitted)?;
            let numbers = if wanted.is_empty() { (0..points.all.len()).collect() } else { points.numbers(wanted).0 };
            for number in numbers {
                let (value, by) = deviation(form, number, &points.at(number));
                self.deviation(&points.all[number].id, value, None, by);
            }
        } else {
            for given in given.iter().filter(|g| wanted.is_empty() || wanted.contains(&g.id)) {
                let Some(number) = points.number(&given.id) else {
                    if !self.measured.missing.contains(&given.id) {
                        self.measured.missing.push(given.id.clone());
                    }
                    continue;
                };
                let difference = points.at(number) - Vector3::from(given.xyz);
                let length = difference.norm();
                let by =
                    (length > 0.0).then(|| Vector::of_point(number, points.at(number)).along(&(difference / length)));
                self.deviation(&given.id, length, Some(difference.into()), by);
            }
        }
        if self.measured.residuals.is_empty() {
            return Err(refused(Reason::FeaturePoints { needed: 1, given: 0 }));
        }
        self.measured.points = self.measured.residuals.len();
        self.summary();
        Ok(())
    }

    fn deviation(&mut self, id: &str, value: f64, difference: Option<[f64; 3]>, by: Option<Function>) {
        let number = self.measured.residuals.len();
        self.measured.residuals.push(FeatureResidual { point: id.into(), value, sigma: None, difference });
        self.functions.extend(by.map(|by| (Figure::Residual(number), by)));
    }
}

/// A form of its kind fitted to its points.
///
/// # Errors
/// [`Reason::FeaturePoints`] with too few of them, [`Reason::FeatureUndetermined`], [`Reason::FeatureUnsettled`].
fn form(kind: &FeatureKind, points: &Points) -> Result<Fitted> {
    let (numbers, _) = points.numbers(kind.points());
    let needed = match kind {
        FeatureKind::Line { .. } => 2,
        FeatureKind::Plane { .. } | FeatureKind::Circle { .. } => 3,
        FeatureKind::Sphere { .. } => 4,
        _ => 6,
    };
    if numbers.len() < needed {
        return Err(refused(Reason::FeaturePoints { needed, given: numbers.len() }));
    }
    let places: Vec<Vector3<f64>> = numbers.iter().map(|k| points.at(*k)).collect();
    fitted(kind, &places, &numbers)
}

/// Fitted about the points' centroid and by their extent, so that no coordinates cost digits.
pub fn fitted(kind: &FeatureKind, places: &[Vector3<f64>], numbers: &[usize]) -> Result<Fitted> {
    let undetermined = || refused(Reason::FeatureUndetermined);
    let spread = PrincipalAxes::of(places).map_err(|_| undetermined())?;
    let size = spread.extent.norm();
    let line = matches!(kind, FeatureKind::Line { .. });
    if !(size > 0.0) || (!line && spread.is_line()) {
        return Err(undetermined());
    }
    let reduced: Vec<Vector3<f64>> = places.iter().map(|p| (p - spread.centroid) / size).collect();
    let axis = |k: usize| spread.axes.column(k).into_owned();
    let back = Back { centroid: spread.centroid, size, numbers };
    match kind {
        FeatureKind::Line { .. } => {
            let fitted =
                fit(Line { position: Vector3::zeros(), direction: axis(0) }, &reduced, numbers).map_err(|f| f.error)?;
            // From the first of its points to the last.
            let run = reduced[reduced.len() - 1] - reduced[0];
            let sign = if run.dot(&fitted.form.direction) < 0.0 { -1.0 } else { 1.0 };
            let (position, direction) = (fitted.form.position, fitted.form.direction);
            Ok(back.fitted(&fitted, Shape::Line, (position, direction), sign, &reduced))
        }
        FeatureKind::Plane { .. } => {
            let fitted =
                fit(Plane { position: Vector3::zeros(), normal: axis(2) }, &reduced, numbers).map_err(|f| f.error)?;
            let (position, normal) = (fitted.form.position, fitted.form.normal);
            Ok(back.fitted(&fitted, Shape::Plane, (position, normal), upwards(&normal), &reduced))
        }
        FeatureKind::Circle { .. } => {
            let initial = Circle::initial(&reduced, &axis(2)).ok_or_else(undetermined)?;
            let fitted = fit(initial, &reduced, numbers).map_err(|f| f.error)?;
            let (centre, normal) = (fitted.form.centre, fitted.form.normal);
            Ok(back.fitted(&fitted, Shape::Circle, (centre, normal), upwards(&normal), &reduced))
        }
        FeatureKind::Sphere { .. } => {
            if spread.is_plane() {
                return Err(undetermined());
            }
            let initial = Sphere::initial(&reduced).ok_or_else(undetermined)?;
            let fitted = fit(initial, &reduced, numbers).map_err(|f| f.error)?;
            let centre = fitted.form.centre;
            Ok(back.fitted(&fitted, Shape::Place, (centre, Vector3::zeros()), 1.0, &reduced))
        }
        _ => {
            let best = best(Cylinder::initial(&reduced).into_iter().map(|initial| fit(initial, &reduced, numbers)))?;
            let (position, direction) = (best.form.axis.position, best.form.axis.direction);
            Ok(back.fitted(&best, Shape::Cylinder, (position, direction), upwards(&direction), &reduced))
        }
    }
}

/// Sign that turns a direction of no sense upwards: its largest component is positive.
fn upwards(direction: &Vector3<f64>) -> f64 {
    if direction[direction.iamax()] < 0.0 { -1.0 } else { 1.0 }
}

/// From reduced coordinates to the object's.
struct Back<'a> {
    centroid: Vector3<f64>,
    size: f64,
    numbers: &'a [usize],
}

impl Back<'_> {
    fn fitted<F: GeometricForm>(
        &self,
        fit: &Regression<F>,
        shape: Shape,
        (position, direction): (Vector3<f64>, Vector3<f64>),
        sign: f64,
        reduced: &[Vector3<f64>],
    ) -> Fitted {
        let by = &fit.by;
        let count = self.numbers.len() as f64;
        let mean = |g: Vector3<f64>| -> Function { self.numbers.iter().map(|k| (*k, g / count)).collect() };
        let sides = across(&direction);
        let vector = |parts: &[(Vector3<f64>, Function)]| -> [Function; 3] {
            std::array::from_fn(|axis| sum(parts.iter().map(|(e, f)| (e[axis], f))))
        };
        // The part of the foot's movement that the form does not tell is that of the centroid along it; reduced, that is at 0.
        let off = |side: usize| -sides[side].dot(&position);
        let (moves, turns, radius) = match shape {
            Shape::Plane => (
                vec![(direction, by[0].clone()), (sides[0], mean(sides[0])), (sides[1], mean(sides[1]))],
                Some((1, 2)),
                None,
            ),
            // An axis that turns takes the foot along by what the centroid is off it.
            Shape::Line | Shape::Cylinder => (
                vec![
                    (sides[0], by[0].clone()),
                    (sides[1], by[1].clone()),
                    (direction, sum([(1.0, &mean(direction)), (off(0), &by[2]), (off(1), &by[3])])),
                ],
                Some((2, 3)),
                (shape == Shape::Cylinder).then_some(4),
            ),
            Shape::Circle | Shape::Place => (
                (0..3).map(|k| (super::linear::axis_of(k), by[k].clone())).collect(),
                (shape == Shape::Circle).then_some((3, 4)),
                Some(if shape == Shape::Circle { 5 } else { 3 }),
            ),
        };
        let direction = turns.map(|(a, b)| {
            let by =
                vector(&[(sign / self.size * sides[0], by[a].clone()), (sign / self.size * sides[1], by[b].clone())]);
            Vector { value: sign * direction, by }
        });
        // At its centre or on its axis a round form is its radius away.
        let radius = radius.map(|k| (-fit.form.distance(&position) * self.size, by[k].clone()));
        let residuals = reduced.iter().map(|x| {
            let d = fit.form.distance(x) * self.size;
            if shape == Shape::Plane { sign * d } else { d }
        });
        Fitted {
            position: Vector { value: self.centroid + self.size * position, by: vector(&moves) },
            direction,
            radius,
            shape,
            residuals: residuals.collect(),
        }
    }
}

/// Takes the standard errors from weak forms, and from what is measured from these.
fn withhold(features: &[Feature], pending: &mut [Pending]) {
    let weakness = |measured: &MeasuredFeature| {
        let radius = match (measured.quantity, measured.value, measured.sigma) {
            (Some(Quantity::Diameter), Some(value), Some(sigma)) => sigma / value,
            _ => 0.0,
        };
        Some(radius.max(measured.sigma_direction.unwrap_or(0.0))).filter(|weak| *weak > LINEAR)
    };
    let own: HashMap<&str, f64> = features
        .iter()
        .zip(pending.iter())
        .filter(|(feature, _)| is_form(&feature.kind))
        .filter_map(|(feature, p)| Some((feature.id.as_str(), weakness(&p.measured)?)))
        .collect();
    for (feature, Pending { measured, .. }) in features.iter().zip(pending) {
        let of = |end: &End| match end {
            End::Feature(id) => own.get(id.as_str()).copied(),
            End::Point(_) => None,
        };
        let from = match &feature.kind {
            FeatureKind::Distance { from, to } => [of(from), of(to), None],
            FeatureKind::Angle { from, at, to } => [of(from), at.as_ref().and_then(of), of(to)],
            FeatureKind::Deviations { feature, .. } => {
                [feature.as_ref().and_then(|id| own.get(id.as_str()).copied()), None, None]
            }
            _ => [own.get(feature.id.as_str()).copied(), None, None],
        };
        measured.weak = from.into_iter().flatten().reduce(f64::max);
        if measured.weak.is_some() {
            (measured.sigma, measured.sigma_position, measured.sigma_direction) = (None, None, None);
            measured.residuals.iter_mut().for_each(|residual| residual.sigma = None);
        }
    }
}

/// Standard errors of all figures.
fn sigmas(pending: &mut [Pending], carry: Carry<'_>) -> Result<()> {
    let places: Vec<(usize, usize)> =
        pending.iter().enumerate().flat_map(|(k, p)| (0..p.functions.len()).map(move |n| (k, n))).collect();
    for places in places.chunks(AT_ONCE) {
        let functions: Vec<Function> = places.iter().map(|&(k, n)| pending[k].functions[n].1.clone()).collect();
        let Some(carried) = carry(&functions)? else { return Ok(()) };
        for (place, &(k, n)) in places.iter().enumerate() {
            let variance = covariance(&functions[place], &carried[place]);
            let sigma = root(variance);
            let Pending { measured, functions: own } = &mut pending[k];
            match own[n].0 {
                Figure::Value => measured.sigma = Some(sigma),
                Figure::Position(axis) => measured.sigma_position.get_or_insert_default()[axis] = sigma,
                Figure::Direction => measured.sigma_direction = Some(sigma),
                Figure::SecondDirection => {
                    // Both of a direction may lie in different chunks; their covariance needs the first only as a function.
                    let first = &own[n - 1].1;
                    let one = measured.sigma_direction.unwrap_or(0.0).powi(2);
                    let both = Matrix2::new(
                        one,
                        covariance(first, &carried[place]),
                        covariance(first, &carried[place]),
                        variance,
                    );
                    measured.sigma_direction = Some(root(both.symmetric_eigenvalues().max()));
                }
                Figure::Residual(number) => measured.residuals[number].sigma = Some(sigma),
            }
        }
    }
    Ok(())
}
