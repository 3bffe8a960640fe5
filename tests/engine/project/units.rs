//! A project in another unit: every result of the adjustment scales with a power of the factor, and nothing is left behind.

use serde_json::Value;
use sightline::adjust::adjust;
use sightline::adjustment::AdjustOptions;
use sightline::project::{
    CoordinateSystem, End, Feature, FeatureKind, Form, GivenPoint, LengthLimit, Plan, PlanStation, Project, SystemKind,
};
use sightline::units::Unit;
use sightline_plan::network::{Source, simulate};

use crate::support::networks::Uniform;

/// The sample's network with everything that has a length: diameters, observed centres, features, systems, a plan.
fn project(seed: u64) -> Project {
    let mut random = Uniform(seed + 1);
    let mut network = sightline_lab::sample::network();
    network.observations = Source::Noisy;
    network.exposure.seed = seed;
    let mut project = simulate(&network).unwrap();
    let near = |value: f64, random: &mut Uniform| value + random.between(-0.5, 0.5);
    for photo in project.photos.iter_mut().step_by(3) {
        photo.sigma_position = Some([Some(2.0), None, Some(3.0)]);
    }
    let known: Vec<GivenPoint> = project
        .points
        .iter()
        .filter_map(|p| Some((p.id.clone(), p.xyz?)))
        .map(|(id, xyz)| GivenPoint { id, xyz: xyz.map(|x| near(x, &mut random)), sigma: Some([0.1, 0.2, 0.3]) })
        .take(6)
        .collect();
    let ids: Vec<String> = known.iter().map(|g| g.id.clone()).collect();
    let feature = |id: &str, kind| Feature { id: id.into(), kind };
    project.features = vec![
        feature("plane", FeatureKind::Plane { points: ids.clone() }),
        feature("length", FeatureKind::Distance { from: End::Point(ids[0].clone()), to: End::Point(ids[3].clone()) }),
        feature("given", FeatureKind::Deviations { points: Vec::new(), feature: None, given: known.clone() }),
    ];
    let fit =
        |id: &str, scale| CoordinateSystem { id: id.into(), kind: SystemKind::BestFit { given: known.clone(), scale } };
    project.systems = vec![fit("rigid", false), fit("similar", true)];
    project.report.length_limit = Some(LengthLimit { constant: 0.02, per: Some(40_000.0) });
    let form =
        Form::Cylinder { radius: 500.0, height: 900.0, sweep: 6.0, columns: 8, rows: 3, inside: false, diameter: 12.0 };
    let station = PlanStation { position: [0.0, -3000.0, 500.0], look_at: Some([0.0; 3]), ..PlanStation::default() };
    project.plan = Some(Box::new(Plan {
        form: Some(form),
        points: project.points.clone().into(),
        stations: vec![station],
        ..Plan::default()
    }));
    project.plan.as_mut().unwrap().lens.focus = Some(2500.0);
    project
}

/// Every number of a JSON value by its path.
fn numbers(value: &Value, path: &str, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => found.push((path.to_owned(), number.as_f64().unwrap())),
        Value::Array(all) => all.iter().enumerate().for_each(|(k, v)| numbers(v, &format!("{path}/{k}"), found)),
        Value::Object(all) => all.iter().for_each(|(k, v)| numbers(v, &format!("{path}/{k}"), found)),
        _ => {}
    }
}

fn flat(value: &impl serde::Serialize) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    numbers(&serde_json::to_value(value).unwrap(), "", &mut found);
    found
}

#[test]
fn every_result_scales_with_a_power_of_the_factor() {
    // What the iteration did on its way depends on rounding.
    let passing = |path: &str| path.starts_with("/iterations");
    let given = project(7);
    let options = AdjustOptions {
        target_diameter: Some(9.0),
        covariance_of: vec![given.points[0].id.clone(), given.points[5].id.clone()],
        ..AdjustOptions::default()
    };
    let base = flat(&adjust(&given, &options, &mut |_| true).unwrap());
    let mut powers: Vec<Option<i32>> = vec![None; base.len()];
    for factor in [1000.0, Unit::Millimetre.factor(Unit::Foot), 0.001, 37.0] {
        let other = given.scaled(factor).unwrap();
        let scaled_options = AdjustOptions { target_diameter: Some(9.0 * factor), ..options.clone() };
        let other = flat(&adjust(&other, &scaled_options, &mut |_| true).unwrap());
        assert_eq!(base.len(), other.len());
        let mut lengths = 0;
        for (k, ((path, a), (other_path, b))) in base.iter().zip(&other).enumerate() {
            assert_eq!(path, other_path);
            // Digits that only rounding has.
            if passing(path) || a.abs() < 1e-7 {
                continue;
            }
            let power = (b / a).ln() / factor.ln();
            let whole = power.round();
            assert!((power - whole).abs() < 2e-4 && whole.abs() <= 2.0, "{path}: {a} {b}, power {power}");
            assert_eq!(*powers[k].get_or_insert(whole as i32), whole as i32, "{path}: {a} {b}");
            lengths += usize::from(whole == 1.0);
            if path == "/sigma0" || path.starts_with("/cameras/") {
                assert_eq!(whole, 0.0, "{path}");
            }
            if path.starts_with("/points/") && path.contains("/xyz/") {
                assert_eq!(whole, 1.0, "{path}");
            }
        }
        assert!(lengths > 300, "{lengths}");
    }
}

#[test]
fn converted_there_and_back_is_the_same_project() {
    for (seed, [from, to]) in Unit::ALL.into_iter().flat_map(|a| Unit::ALL.map(|b| [a, b])).enumerate() {
        let given = project(seed as u64);
        let there = given.scaled(from.factor(to)).unwrap();
        let back = there.scaled(to.factor(from)).unwrap();
        let (a, b) = (flat(&given), flat(&back));
        assert_eq!(a.len(), b.len());
        for ((path, a), (_, b)) in a.iter().zip(&b) {
            assert!((a - b).abs() <= 1e-14 * a.abs(), "{path}: {a} {b}");
        }
        assert!(given.holds_lengths());
    }
    assert!(!Project::default().holds_lengths());
}

#[test]
fn every_number_of_the_document_is_a_length_or_is_known_to_be_none() {
    let given = project(3);
    let (a, b) = (flat(&given), flat(&given.scaled(2.0).unwrap()));
    // Everything else that a document holds and that no unit changes.
    let none = [
        "/version",
        "/cameras",
        "/observations",
        "/rotation",
        "/normal",
        "/report/coverage_factor",
        "/report/length_limit/per",
        "/plan/cameras",
        "/plan/lens/circle_px",
        "/plan/form/sweep",
        "/plan/form/columns",
        "/plan/form/rows",
        "/plan/sigma",
        "/plan/max_incidence",
        "/plan/margin",
        "/plan/least_px",
        "/plan/wanted/probability",
        "/roll",
    ];
    for ((path, a), (_, b)) in a.iter().zip(&b) {
        let length = !none
            .iter()
            .any(|name| path.starts_with(name) || path.contains(&format!("{name}/")) || path.ends_with(name));
        match (length, path.as_str()) {
            (_, "/plan/lens/unit_mm") => assert_eq!(*b, a / 2.0),
            (true, _) => assert_eq!(*b, 2.0 * a, "{path}"),
            (false, _) => assert_eq!(a, b, "{path}"),
        }
    }
}

#[test]
fn what_would_leave_the_range_of_numbers_is_refused_whole() {
    let mut large = project(1);
    large.points[2].xyz = Some([3e98, 0.0, 0.0]);
    let error = large.scaled(1000.0).unwrap_err();
    assert_eq!((error.code(), error.place().point.as_deref()), ("invalid", Some(large.points[2].id.as_str())));
    let mut small = project(1);
    small.distances[0].sigma = 1e-306;
    assert_eq!(small.scaled(0.001).unwrap_err().code(), "invalid");
    for factor in [0.0, f64::NAN, f64::INFINITY] {
        assert!(project(1).scaled(factor).is_err(), "{factor}");
    }
}
