//! Edits of the plan.

use sightline::Error;
use sightline::axes::ShownAxes;
use sightline::error::{Place, Thing};
use sightline::project::{
    Camera, DatumKind, Feature, FeatureKind, Form, Interior, Parameter, Plan, PlanDistance, PlanFace, PlanStation,
    Point, Project, Region, Role, Variant,
};
use sightline::units::Unit;

use crate::document::Document;

/// Parameters that a calibration on the object estimates.
pub const CALIBRATED: [Parameter; 8] = [
    Parameter::C,
    Parameter::X0,
    Parameter::Y0,
    Parameter::K1,
    Parameter::K2,
    Parameter::K3,
    Parameter::P1,
    Parameter::P2,
];

/// A form to begin with, in the project's unit.
pub fn first_form(kind: &str, mm: f64) -> Form {
    let long = |value: f64| value / mm;
    match kind {
        "box" => {
            Form::Box { size: [long(1000.0), long(800.0), long(600.0)], columns: 3, rows: 2, diameter: long(10.0) }
        }
        "cylinder" => Form::Cylinder {
            radius: long(1000.0),
            height: long(2000.0),
            sweep: std::f64::consts::TAU,
            columns: 16,
            rows: 4,
            inside: false,
            diameter: long(12.0),
        },
        _ => Form::Plane {
            width: long(2000.0),
            height: long(1500.0),
            columns: 6,
            rows: 5,
            upright: true,
            diameter: long(12.0),
        },
    }
}

/// A common camera: 28 mm on 36 x 24 mm with 6000 x 4000 pixels.
pub fn common_camera() -> Camera {
    Camera { pixel_pitch: Some([0.006; 2]), ..Camera::new("1", 6000, 4000, Interior::brown(28.0)) }
}

/// Whether a camera's principal distance is known.
pub fn is_known(camera: &Camera) -> bool {
    camera.interior.get(Parameter::C).or(camera.interior.get(Parameter::Fx)).is_some()
}

/// A plan of nothing yet, with the project's camera where it has one that is known.
fn empty(project: &Project, mm: f64) -> Plan {
    let camera = project.cameras.iter().find(|c| is_known(c)).cloned().unwrap_or_else(common_camera);
    let mut plan = Plan { cameras: vec![camera], ..Plan::default() };
    plan.wanted.precision = 0.1 / mm;
    plan.lens.unit_mm = mm;
    plan
}

/// Begins a plan of a form.
pub fn begin(project: &mut Project, form: Form, mm: f64) {
    let mut plan = empty(project, mm);
    set_form(&mut plan, form);
    // Targets that the camera cannot measure are no beginning.
    let wanted = sightline_plan::least_diameter(&plan).map(|least| round_up(least * mm) / mm);
    if let Some(wanted) = wanted.filter(|wanted| *wanted > diameter_of(&form)) {
        set_form(&mut plan, with_diameter(form, wanted));
    }
    project.plan = Some(Box::new(plan));
}

/// Puts a plan that was made elsewhere in place of the document's. A document of nothing takes the unit that it comes with; otherwise its
/// lengths are in the document's. With a unit that is not known, the plan's own millimetres stay.
pub fn put(document: &mut Document, mut made: Plan, unit: Option<&str>) {
    let fresh = document.is_empty();
    let project = document.project_mut();
    if let Some(unit) = unit.filter(|_| fresh) {
        project.unit = unit.to_owned();
    }
    made.lens.unit_mm = millimetres(&project.unit).unwrap_or(made.lens.unit_mm);
    project.plan = Some(Box::new(made));
}

/// Millimetres of a unit; `None` if it is not known.
pub fn millimetres(unit: &str) -> Option<f64> {
    Unit::named(unit).map(Unit::millimetres)
}

/// Changes the project's plan; whether it has one.
pub fn change(project: &mut Project, edit: impl FnOnce(&mut Plan)) -> bool {
    project.plan.as_deref_mut().map(edit).is_some()
}

/// Takes the plan away; whether there was one.
pub fn remove(project: &mut Project) -> bool {
    project.plan.take().is_some()
}

/// The next of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten.
fn round_up(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.iter().map(|step| step * power).find(|rounded| *rounded >= 0.999 * value).unwrap_or(value)
}

fn diameter_of(form: &Form) -> f64 {
    match *form {
        Form::Plane { diameter, .. } | Form::Box { diameter, .. } | Form::Cylinder { diameter, .. } => diameter,
    }
}

fn with_diameter(mut form: Form, wanted: f64) -> Form {
    match &mut form {
        Form::Plane { diameter, .. } | Form::Box { diameter, .. } | Form::Cylinder { diameter, .. } => {
            *diameter = wanted;
        }
    }
    form
}

/// Takes points into the plan, or begins one of them. What is known of a point's target stays with its name.
pub fn take_points(project: &mut Project, points: Vec<Point>, mm: f64) {
    let mut plan = project.plan.take().map_or_else(|| empty(project, mm), |plan| *plan);
    let given = plan.form.is_none() && !plan.points.is_empty();
    let (facing, diameter) = (facing(&plan), plan.points.first().and_then(|p| p.diameter));
    let fresh = points.into_iter().map(|point| match plan.points.iter().find(|p| given && p.id == point.id) {
        Some(old) => Point { xyz: point.xyz, ..old.clone() },
        None => Point { diameter: diameter.filter(|_| given), role: Role::Tie, sigma: None, ..point },
    });
    let fresh = fresh.collect();
    let own = faces_of_form(&plan);
    plan.faces.drain(..own);
    plan.form = None;
    plan.points = fresh;
    if let (Some(facing), true) = (facing, given) {
        set_facing(&mut plan, facing);
    }
    drop_unknown(&mut plan);
    project.plan = Some(Box::new(plan));
}

/// Points of the plan as text, one line per point: identifier and coordinates.
pub fn points_text(plan: &Plan, axes: ShownAxes) -> String {
    let line = |point: &Point| {
        let [x, y, z] = axes.shown(point.xyz.unwrap_or_default());
        format!("{}, {x}, {y}, {z}\n", point.id)
    };
    plan.points.iter().map(line).collect()
}

/// Which way targets face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// Seen from every side, as balls are.
    Every,
    /// Towards -Y.
    Front,
    /// Towards +Z.
    Up,
    /// Away from the middle of all points.
    Outward,
}

/// Which way the targets face, where all do the same.
pub fn facing(plan: &Plan) -> Option<Facing> {
    let all = |normal: Option<[f64; 3]>| plan.points.iter().all(|p| p.normal == normal);
    if all(None) {
        return Some(Facing::Every);
    }
    if all(Some([0.0, -1.0, 0.0])) {
        return Some(Facing::Front);
    }
    if all(Some([0.0, 0.0, 1.0])) {
        return Some(Facing::Up);
    }
    let middle = middle(plan);
    plan.points.iter().all(|p| p.normal == outward(p, middle)).then_some(Facing::Outward)
}

/// Turns all targets.
pub fn set_facing(plan: &mut Plan, facing: Facing) {
    let middle = middle(plan);
    for point in &mut plan.points {
        point.normal = match facing {
            Facing::Every => None,
            Facing::Front => Some([0.0, -1.0, 0.0]),
            Facing::Up => Some([0.0, 0.0, 1.0]),
            Facing::Outward => outward(point, middle),
        };
    }
}

fn middle(plan: &Plan) -> [f64; 3] {
    let places: Vec<[f64; 3]> = plan.points.iter().filter_map(|p| p.xyz).collect();
    [0, 1, 2].map(|a| places.iter().map(|p| p[a]).sum::<f64>() / places.len().max(1) as f64)
}

/// The direction from the middle; a point that lies there has none.
fn outward(point: &Point, middle: [f64; 3]) -> Option<[f64; 3]> {
    let away = point.xyz.map(|p| [0, 1, 2].map(|a| p[a] - middle[a]))?;
    let length = away.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0).then(|| away.map(|x| x / length))
}

/// One diameter for all targets, or none that is known.
pub fn set_diameter(plan: &mut Plan, diameter: Option<f64>) {
    plan.points.iter_mut().for_each(|point| point.diameter = diameter);
}

/// The plan's control points.
pub fn control(plan: &Plan) -> Vec<&str> {
    plan.points.iter().filter(|p| p.role == Role::Control).map(|p| p.id.as_str()).collect()
}

/// The standard error of the first control point's first coordinate.
pub fn control_sigma(plan: &Plan) -> Option<f64> {
    plan.points.iter().find(|p| p.role == Role::Control)?.sigma?[0]
}

/// Makes exactly these points control points.
///
/// # Errors
/// [`Error::Unknown`] for a point that the plan does not have; then nothing is changed.
pub fn set_control(plan: &mut Plan, names: &[String]) -> Result<(), Error> {
    if let Some(name) = names.iter().find(|name| !plan.points.iter().any(|p| p.id == **name)) {
        return Err(Error::Unknown { kind: Thing::Point, name: name.clone(), at: Place::default() });
    }
    let sigma = control_sigma(plan);
    for point in &mut plan.points {
        let named = names.contains(&point.id);
        if named && point.role != Role::Control {
            (point.role, point.sigma) = (Role::Control, sigma.map(|s| [Some(s); 3]));
        } else if !named && point.role == Role::Control {
            (point.role, point.sigma) = (Role::Tie, None);
        }
    }
    if names.is_empty() && plan.datum.kind == DatumKind::Control {
        plan.datum.kind = DatumKind::Free;
    }
    Ok(())
}

/// How well control points are known; none: without error.
pub fn set_control_sigma(plan: &mut Plan, sigma: Option<f64>) {
    for point in plan.points.iter_mut().filter(|p| p.role == Role::Control) {
        point.sigma = sigma.map(|s| [Some(s); 3]);
    }
}

/// How many of the plan's faces, the first, are its form's.
pub fn faces_of_form(plan: &Plan) -> usize {
    plan.form.as_ref().map_or(0, sightline_plan::faces_on).min(plan.faces.len())
}

/// A face from three corners, as "x, y, z, x, y, z, x, y, z": the middle one lies between the two others.
pub fn face(numbers: &[f64]) -> Option<PlanFace> {
    let [a, b, c, d, e, f, g, h, i] = *numbers else { return None };
    let corner = [d, e, f];
    let to = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] - corner[k]);
    let (along, across) = (to([a, b, c]), to([g, h, i]));
    let [x, y] = [along, across];
    let area = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    let wide = numbers.iter().all(|v| v.abs() < 1e9) && area.iter().any(|v| v.abs() > 1e-12);
    wide.then_some(PlanFace { corner, along, across })
}

/// Points of the project's features that the plan has, by the feature's name.
pub fn features(project: &Project, plan: &Plan) -> Vec<(String, Vec<String>)> {
    let of = |feature: &Feature| {
        let (FeatureKind::Line { points }
        | FeatureKind::Plane { points }
        | FeatureKind::Circle { points }
        | FeatureKind::Sphere { points }
        | FeatureKind::Cylinder { points }) = &feature.kind
        else {
            return None;
        };
        let planned = |id: &&String| plan.points.iter().any(|p| p.id == **id);
        let points: Vec<String> = points.iter().filter(planned).cloned().collect();
        (!points.is_empty()).then(|| (feature.id.clone(), points))
    };
    project.features.iter().filter_map(of).collect()
}

/// Plans with another camera; whether it is calibrated with the photos stays.
pub fn set_camera(plan: &mut Plan, camera: Camera) {
    let calibrated = calibrates(plan);
    plan.cameras = vec![camera];
    plan.stations.iter_mut().for_each(|station| station.camera.clear());
    plan.variants.iter_mut().flat_map(|v| &mut v.stations).for_each(|station| station.camera.clear());
    set_calibrates(plan, calibrated);
}

/// Puts targets on another form; what names points that are gone goes with them.
pub fn set_form(plan: &mut Plan, form: Form) {
    let Ok((points, faces)) = sightline_plan::targets_on(&form) else { return };
    let own = faces_of_form(plan);
    plan.faces.splice(..own, faces);
    plan.form = Some(form);
    plan.points = points;
    drop_unknown(plan);
}

/// Removes references to points that no longer exist.
fn drop_unknown(plan: &mut Plan) {
    let ids: std::collections::HashSet<&str> = plan.points.iter().map(|p| p.id.as_str()).collect();
    plan.distances.retain(|d| ids.contains(d.from.as_str()) && ids.contains(d.to.as_str()));
    if plan.datum.points.as_ref().is_some_and(|named| !named.iter().all(|id| ids.contains(id.as_str()))) {
        plan.datum.points = None;
    }
}

/// Whether the form has sizes and counts; the engine decides how many targets it may have.
pub fn is_form(form: &Form) -> bool {
    let size = |values: &[f64]| values.iter().all(|v| *v > 0.0 && *v < 1e9);
    let count = |columns: u32, rows: u32| columns > 0 && rows > 0;
    match *form {
        Form::Plane { width, height, columns, rows, diameter, .. } => {
            size(&[width, height]) && diameter >= 0.0 && count(columns, rows)
        }
        Form::Box { size: sides, columns, rows, diameter } => size(&sides) && diameter >= 0.0 && count(columns, rows),
        Form::Cylinder { radius, height, sweep, columns, rows, diameter, .. } => {
            size(&[radius, height, sweep]) && diameter >= 0.0 && count(columns, rows)
        }
    }
}

/// A number as a count; 0 for anything that is not a whole number.
pub fn counted(number: f64) -> u32 {
    if number.fract() == 0.0 { number as u32 } else { 0 }
}

/// Adds a station in front of the object, aimed at its middle; its identifier.
pub fn add_station(plan: &mut Plan) -> Option<String> {
    let id = next_id(plan);
    let places: Vec<[f64; 3]> = plan.points.iter().filter_map(|p| p.xyz).collect();
    let count = places.len().max(1) as f64;
    let middle = [0, 1, 2].map(|a| places.iter().map(|p| p[a]).sum::<f64>() / count);
    let reach = places.iter().map(|p| (0..3).map(|a| (p[a] - middle[a]).powi(2)).sum::<f64>().sqrt());
    let reach = reach.fold(1.0, f64::max);
    // Beside the last one, so that it does not lie under it.
    let step = plan.stations.len() as f64 * 0.35 * reach;
    let lying = matches!(plan.form, Some(Form::Plane { upright: false, .. }));
    let position = if lying {
        [middle[0] + step, middle[1], middle[2] + 3.0 * reach]
    } else {
        [middle[0] + step, middle[1] - 3.0 * reach, middle[2]]
    };
    plan.stations.push(PlanStation { id: id.clone(), position, look_at: Some(middle), ..PlanStation::default() });
    Some(id)
}

/// The next number that no station has.
pub fn next_id(plan: &Plan) -> String {
    let free = |n: &usize| !plan.stations.iter().any(|s| s.id == n.to_string());
    (plan.stations.len() + 1..).find(free).unwrap_or(1).to_string()
}

/// Moves a station along an axis; it goes on looking at what it looked at.
pub fn move_station(plan: &mut Plan, id: &str, axis: usize, to: f64) {
    if let Some(station) = plan.stations.iter_mut().find(|s| s.id == id) {
        station.position[axis] = to;
    }
}

/// Aims a station elsewhere along one axis.
pub fn aim_station(plan: &mut Plan, id: &str, axis: usize, to: f64) {
    if let Some(aim) = plan.stations.iter_mut().find(|s| s.id == id).and_then(|s| s.look_at.as_mut()) {
        aim[axis] = to;
    }
}

/// Keeps the present stations as another plan to compare with; its name.
pub fn keep_variant(plan: &mut Plan) -> String {
    let name = ('B'..='Z').map(String::from).find(|n| !plan.variants.iter().any(|v| v.name == *n));
    let name = name.unwrap_or_else(|| (plan.variants.len() + 2).to_string());
    plan.variants.push(Variant { name: name.clone(), stations: plan.stations.clone() });
    name
}

/// Exchanges the present stations with those of another plan.
pub fn switch_variant(plan: &mut Plan, place: usize) {
    if let Some(variant) = plan.variants.get_mut(place) {
        std::mem::swap(&mut plan.stations, &mut variant.stations);
    }
}

/// Whether cameras are calibrated with the photos, all of them alike.
pub fn calibrates(plan: &Plan) -> bool {
    plan.cameras.iter().any(|c| !c.free.is_empty())
}

/// Has cameras calibrated with the photos, or holds them.
pub fn set_calibrates(plan: &mut Plan, on: bool) {
    for camera in &mut plan.cameras {
        let known = camera.interior.parameters();
        let wanted = if known.contains(&Parameter::C) { CALIBRATED.as_slice() } else { &Parameter::OPENCV };
        // f is fx = fy.
        let single = |p: &&Parameter| !matches!(p, Parameter::Fx | Parameter::Fy);
        camera.free = if on { wanted.iter().filter(single).copied().collect() } else { Vec::new() };
        camera.sigma.clear();
    }
}

/// A scale bar between the two points that are farthest from each other, or none.
pub fn set_bar(plan: &mut Plan, sigma: Option<f64>) {
    plan.distances.clear();
    let Some(sigma) = sigma else { return };
    let places: Vec<(&String, [f64; 3])> = plan.points.iter().filter_map(|p| Some((&p.id, p.xyz?))).collect();
    let apart = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
    let Some((first, at)) = places.first() else { return };
    // Twice the farthest: enough for a form, whose outline is convex.
    let farthest = |from: [f64; 3]| places.iter().max_by(|a, b| apart(&a.1, &from).total_cmp(&apart(&b.1, &from)));
    let (from, from_at) = farthest(*at).map_or((*first, *at), |(id, at)| (*id, *at));
    let Some((to, _)) = farthest(from_at) else { return };
    if from != *to {
        plan.distances = vec![PlanDistance { from: from.clone(), to: (*to).clone(), sigma }];
    }
}

/// The datum of the prediction.
pub fn set_datum(plan: &mut Plan, kind: DatumKind) {
    plan.datum.kind = kind;
}

/// A box from six numbers, as "x, y, z … x, y, z" in any order of corners.
pub fn region(numbers: &[f64]) -> Option<Region> {
    let [a, b, c, d, e, f] = *numbers else { return None };
    let pair = |p: f64, q: f64| (p.min(q), p.max(q));
    let (x, y, z) = (pair(a, d), pair(b, e), pair(c, f));
    Some(Region { low: [x.0, y.0, z.0], high: [x.1, y.1, z.1] })
}

#[cfg(test)]
mod tests;
