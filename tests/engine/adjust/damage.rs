//! Fuzzing from seeds: documents whose JSON tree is damaged anywhere give a result or an error, in bounded time, and no
//! number that is none.

use crate::support::networks::{Uniform, Wanted, brown, exact, noisy, opencv};
use crate::support::seed_document::seed_document;
use crate::support::tree::{damage, is_finite};
use serde_json::{Value, json};
use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, Adjustment, ResidualPlace, Robust, StatisticsChoice};
use sightline::limits;
use sightline::noise::Noise;
use sightline::project::{Camera, DatumKind, Form, Interior, Parameter, Project, Sigma};
use sightline_exchange::import;
use sightline_exchange::package::{self, Package};
use sightline_plan::network::{self, Network, NetworkPoint, Station};
use sightline_plan::{faces_on, targets_on};
use sightline_report::sheets::{Field, SheetOptions, target_sheets};

/// Iterations of one of these documents before it counts as endless: every round of a search for gross errors has some.
const MOST_ITERATIONS: usize = 5000;

/// Adjusts a document and looks at every number of what comes back; whether it was a result.
fn adjusted(project: &Project, options: &AdjustOptions, round: usize) -> bool {
    let mut iterations = 0;
    #[cfg(not(target_arch = "wasm32"))]
    let began = std::time::Instant::now();
    let outcome = adjust(project, options, &mut |_| {
        iterations += 1;
        true
    });
    assert!(iterations < MOST_ITERATIONS, "round {round}: {iterations} iterations");
    #[cfg(not(target_arch = "wasm32"))]
    assert!(began.elapsed().as_secs() < 10, "round {round}: {:?}", began.elapsed());
    match outcome {
        Ok(adjustment) => {
            assert!(is_finite(&format!("{adjustment:?}")), "round {round}");
            let applied = apply(project, &adjustment);
            assert!(is_finite(&format!("{applied:?}")), "round {round}");
            // What is written is read again, every bit of it.
            let json = package::json(&adjustment).expect("a result without infinity");
            assert_eq!(serde_json::from_slice::<Adjustment>(&json).expect("a result"), adjustment, "round {round}");
            let content = Package { project: applied, adjustment: Some(adjustment), ..Package::default() };
            let file = package::write(&content).expect("a file");
            assert_eq!(package::read(&file).expect("a project"), content, "round {round}");
            true
        }
        Err(error) => {
            assert!(!error.to_string().is_empty() && is_finite(&format!("{error:?}")), "round {round}: {error}");
            false
        }
    }
}

#[test]
fn damaged_json_gives_a_result_or_an_error() {
    let cameras = vec![brown(&[Parameter::C, Parameter::K1]), opencv(&[Parameter::F])];
    let wanted = Wanted { photos: 4, points: 9, distances: (1, 0.1), control: (3, 0.1), cameras, ..Wanted::default() };
    let sound = noisy(&exact(&wanted, 29), &mut Noise::new(29, 0));
    let mut random = Uniform(1234);
    let mut below = |n: usize| random.between(0.0, n as f64) as usize;
    let (mut results, mut errors, mut refused) = (0, 0, 0);
    for round in 0..900 {
        let mut project = sound.clone();
        project.datum.kind = [DatumKind::Free, DatumKind::Minimal, DatumKind::Control][round % 3];
        project.photos[1].sigma_position = Some([Some(1.0), None, Some(2.0)]);
        project.cameras[1].sigma = [(Parameter::Cx, 0.5)].into();
        project.cameras[0].per_photo = round % 5 == 0;
        for point in &mut project.points[..round % 6] {
            (point.diameter, point.normal) = (Some(10.0), Some([0.1, 0.2, 1.0]).filter(|_| round % 2 == 0));
        }
        let mut document = serde_json::to_value(&project).expect("a document");
        (0..1 + round % 5).for_each(|_| damage(&mut document, &mut below));
        let Ok(project) = serde_json::from_value::<Project>(document) else {
            refused += 1;
            continue;
        };
        let options = AdjustOptions {
            snooping: round % 7 == 0,
            robust: [None, Some(Robust::Huber), Some(Robust::Tukey)][if round % 11 == 0 { round % 3 } else { 0 }],
            residuals: [ResidualPlace::Corrected, ResidualPlace::Measured][round / 3 % 2],
            covariance_of: if round % 13 == 0 { vec!["p1".into(), "p4".into()] } else { Vec::new() },
            ..AdjustOptions::default()
        };
        let kind = if adjusted(&project, &options, round) { &mut results } else { &mut errors };
        *kind += 1;
    }
    assert!(results > 150 && errors > 100 && refused > 100, "{results} results, {errors} errors, {refused} refused");
}

/// Principal distances and standard errors next to nothing: what a standard error should be is not reported as infinite then.
#[test]
fn numbers_too_small_to_compute_with_make_no_infinite_ones() {
    let wanted = Wanted { photos: 4, points: 9, distances: (1, 0.1), cameras: vec![brown(&[])], ..Wanted::default() };
    let sound = noisy(&exact(&wanted, 29), &mut Noise::new(29, 0));
    let mut told = 0;
    for (round, [c, sigma]) in
        [[1e-300, 1e-300], [1e-200, 1e-300], [1e-300, 1.0], [80.0, 1e-300]].into_iter().enumerate()
    {
        let mut project = sound.clone();
        project.cameras[0].interior.set(Parameter::C, c);
        project.distances[0].sigma = sigma;
        told += usize::from(!adjusted(&project, &AdjustOptions::default(), round));
    }
    assert_eq!(told, 4);
}

/// A measurement that is said to be exact beside one far outside the photo: a step overflows, and is told by a number all the same.
#[test]
fn a_step_that_overflows_is_told_by_a_number() {
    let mut project = seed_document(1);
    project.cameras[0].width = 5461;
    project.photos[1].sigma_position = Some([Some(1.0), None, Some(1e-9)]);
    // Two more are wrong by some thousand pixels.
    for o in &mut project.observations {
        match (o.photo.as_str(), o.point.as_str()) {
            ("f1", "p0") => o.sigma = Sigma::One(1e-300),
            ("f1", "p4") => o.v = -1e18,
            ("f0", "p3") => o.v = -995.081912945395,
            ("f4", "p7") => o.u = 2263.3140981701404,
            _ => {}
        }
    }
    let options = AdjustOptions {
        robust: Some(Robust::Tukey),
        unmodelled: 0.05,
        statistics: StatisticsChoice::Precision,
        ..AdjustOptions::default()
    };
    let mut most = 0.0;
    let outcome = adjust(&project, &options, &mut |iteration| {
        most = iteration.step.max(most);
        true
    });
    // The largest number where this was found; what it comes to hangs on the last digits of sines.
    assert!(outcome.is_ok() && most > 1e12, "{most}");
    assert!(adjusted(&project, &options, 0));
}

/// Networks that hang by a thread: everything free, few rays, starting far from the truth. Many never converge.
#[test]
fn an_adjustment_that_no_longer_gains_ends_however_many_iterations_are_allowed() {
    let mut random = Uniform(77);
    let (mut longest, mut ended) = (0, std::collections::BTreeMap::new());
    for round in 0..300_u64 {
        let free = [Parameter::C, Parameter::X0, Parameter::K1, Parameter::K2, Parameter::P1, Parameter::B1];
        let cameras = vec![brown(&free[..1 + round as usize % 6])];
        let (photos, points) = (2 + round as usize % 4, 5 + round as usize % 9);
        let wanted = Wanted { photos, points, cameras, ..Wanted::default() };
        let mut project = noisy(&exact(&wanted, round), &mut Noise::new(round, 0));
        let far = 10f64.powf(random.between(-1.0, 2.5));
        for point in &mut project.points {
            point.xyz = point.xyz.map(|xyz| xyz.map(|x| x + far * random.between(-1.0, 1.0)));
        }
        for photo in &mut project.photos {
            photo.position = photo.position.map(|xyz| xyz.map(|x| x + far * random.between(-1.0, 1.0)));
        }
        for observation in project.observations.iter_mut().filter(|_| round % 3 == 0) {
            if random.between(0.0, 1.0) < 0.2 {
                observation.u += random.between(-300.0, 300.0);
            }
        }
        let options = AdjustOptions {
            max_iterations: 1_000_000_000,
            robust: [None, Some(Robust::Huber), Some(Robust::Tukey)][round as usize / 2 % 3],
            ..AdjustOptions::default()
        };
        let mut iterations = 0;
        // A search for gross errors adjusts again and again, each of them bounded.
        let outcome = adjust(&project, &options, &mut |_| {
            iterations += 1;
            assert!(iterations < 100_000, "round {round} does not end");
            true
        });
        longest = longest.max(iterations);
        let kind = outcome.map_or("refused".to_owned(), |adjustment| format!("{:?}", adjustment.termination));
        *ended.entry(kind).or_insert(0) += 1;
    }
    println!("longest {longest} iterations; {ended:?}");
    assert!(!ended.contains_key("IterationLimit"), "{ended:?}");
    assert!(ended.get("Converged").is_some_and(|n| *n > 50), "{ended:?}");
    assert!(ended.get("Diverged").is_some_and(|n| *n > 5), "{ended:?}");
}

/// Counts that run over 32 bits, and sizes that leave every picture: found by calls of the JavaScript face with damaged arguments.
#[test]
fn what_would_take_all_memory_is_refused_before() {
    let plane = |width, columns, rows| Form::Plane { width, height: 1.0, columns, rows, upright: true, diameter: 0.1 };
    for (form, fits) in [
        (plane(1.0, 250, 40), true),
        (plane(1.0, 250, 41), false),
        (plane(1.0, u32::MAX, u32::MAX), false),
        (plane(1e300, 1, 1), false),
        (Form::Box { size: [1.0; 3], columns: 65_536, rows: 65_536, diameter: 0.1 }, false),
        (
            Form::Cylinder {
                radius: 1.0,
                height: 1.0,
                sweep: 9.0,
                columns: 70_000,
                rows: 2,
                inside: true,
                diameter: 0.1,
            },
            false,
        ),
    ] {
        match targets_on(&form) {
            Ok((points, faces)) => {
                assert!(fits && points.len() <= limits::TARGETS && faces.len() == faces_on(&form), "{form:?}");
            }
            Err(error) => assert!(!fits && error.code() == "invalid", "{form:?}: {error}"),
        }
    }
    let sheets = |field: [u32; 2], bars, dots| {
        let field = Some(Field { columns: field[0], rows: field[1] });
        target_sheets(&SheetOptions { field, bars, dots, ..SheetOptions::default() }).map(|sheets| sheets.pages.len())
    };
    assert!(sheets([1, 1], 0, 10).is_ok());
    for (field, bars, dots) in
        [([65_536, 65_536], 0, 0), ([1, 1], 1 << 31, 0), ([1, 1], 0, u32::MAX), ([u32::MAX, 2], 7, 0)]
    {
        assert_eq!(sheets(field, bars, dots).expect_err("too many").code(), "invalid");
    }
    // a target as large as a mountain, one that fills the picture and one that leaves it on every side, each over all of it
    for diameter in [1e-9, 0.1, 5.0, 100.0, 1e5, 1e9, 1e200] {
        let point = NetworkPoint {
            id: "p".into(),
            normal: Some([0.0, 0.0, 1.0]),
            diameter: Some(diameter),
            ..NetworkPoint::default()
        };
        let network = Network {
            cameras: vec![Camera { pixel_pitch: Some([0.01; 2]), ..Camera::new("c", 300, 200, Interior::brown(3.0)) }],
            stations: vec![Station::aimed("s", "c", [0.1, 0.0, 1.0], [0.0; 3], 0.3)],
            points: vec![point],
            ..Network::default()
        };
        let photo = network::photo(&network, "s").expect("a photo");
        assert_eq!((photo.width, photo.height), (300, 200), "{diameter}");
    }
}

/// An error's words name a place as people write it, and never print the document.
#[test]
fn what_is_wrong_in_a_document_is_told_with_its_place_in_few_words() {
    let cameras = vec![brown(&[Parameter::C, Parameter::K1]), opencv(&[Parameter::F])];
    let sound = exact(&Wanted { photos: 4, points: 9, cameras, ..Wanted::default() }, 3);
    let mut random = Uniform(4321);
    let mut below = |n: usize| random.between(0.0, n as f64) as usize;
    let odd =
        [json!([[1, 2], [3, 4]]), json!("x".repeat(3000)), json!({"a": {"b": []}}), json!(vec![7; 5000]), json!(-1)];
    let (mut refused, mut placed) = (0, 0);
    for round in 0..3000 {
        let mut document = serde_json::to_value(&sound).expect("a document");
        *somewhere(&mut document, &mut below) = odd[round % odd.len()].clone();
        let bytes = serde_json::to_vec(&document).expect("JSON");
        let Err(error) = import("sightline", &[("a.json".to_owned(), bytes)].into()) else { continue };
        refused += 1;
        let words = error.to_string();
        assert!(words.len() < 400, "round {round}: {} characters: {}", words.len(), &words[..400]);
        let place = error.place();
        assert_eq!(place.file.as_deref(), Some("a.json"), "round {round}: {words}");
        let Some(field) = &place.field else { continue };
        assert!(!field.contains(".[") && !field.contains('?') && field.len() < 100, "round {round}: {field}: {words}");
        placed += 1;
    }
    assert!(refused > 1500 && placed * 10 > refused * 9, "{refused} refused, {placed} of them with a place");
}

/// A value somewhere in a tree.
fn somewhere<'a>(value: &'a mut Value, below: &mut dyn FnMut(usize) -> usize) -> &'a mut Value {
    let count = match &*value {
        Value::Array(list) => list.len(),
        Value::Object(fields) => fields.len(),
        _ => 0,
    };
    if count == 0 || below(12) == 0 {
        return value;
    }
    let at = below(count);
    match value {
        Value::Array(list) => somewhere(&mut list[at], below),
        Value::Object(fields) => somewhere(fields.iter_mut().nth(at).expect("a field").1, below),
        leaf => leaf,
    }
}
