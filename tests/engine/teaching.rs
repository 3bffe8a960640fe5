//! What is shown of an adjustment to those who learn, against the adjustment itself and against dense algebra.

use nalgebra::{DMatrix, DVector};
use sightline::adjust::{Adjuster, Unknown, adjust, at_end, linearise, start_adjustment};
use sightline::adjustment::AdjustOptions;
use sightline::project::DatumKind;
use sightline_lab::teaching::{
    Lesson, LessonProgress, Planting, Reached, biases, cofactors, datums, evaluate, explain, files, lab, lessons,
    moved, plant, sigmas, transformed,
};

fn options() -> AdjustOptions {
    AdjustOptions::default()
}

#[test]
fn an_explained_observation_adds_up() {
    let mut adjuster = start_adjustment(&moved(&lab().expect("the lab net"), 0.003), &options()).expect("a start");
    adds_up(&adjuster);
    while adjuster.state().termination.is_none() {
        let state = adjuster.step().expect("a step");
        // The last steps turn photos by less than rounding leaves of a trace.
        assert!(state.corrections.iter().all(|dx| dx.is_finite()));
    }
    adds_up(&adjuster);
}

fn adds_up(adjuster: &Adjuster) {
    let system = adjuster.linear_system().expect("a system");
    let residuals = adjuster.state().residuals.iter();
    assert!(system.l.iter().zip(residuals).all(|(l, v)| *l == -v));
    for row in (0..system.observations.len()).step_by(17) {
        let found = explain(adjuster, &options(), row).expect("an explanation");
        if system.observations[row].given.is_some() {
            assert!(found.collinearity.is_none());
            continue;
        }
        let c = found.collinearity.expect("an image coordinate");
        assert!((c.computed - (system.observations[row].value - system.l[row])).abs() < 1e-12);
        // Of the distortion alone: a fraction of a millimetre.
        assert!(c.correction.abs() < 0.5, "{}", c.correction);
        for one in found.derivatives {
            let size = system.a.dense().column(one.unknown).amax();
            assert!((one.analytic - one.numerical.expect("of an image coordinate")).abs() < 2e-6 * size);
        }
    }
}

#[test]
fn standard_errors_of_the_unknowns_are_those_of_the_adjustment() {
    for kind in [DatumKind::Control, DatumKind::Free] {
        let mut project = lab().expect("the lab net");
        project.datum.kind = kind;
        let adjustment = adjust(&project, &options(), &mut |_| true).expect("a result");
        let end = at_end(&project, &options()).expect("an end");
        let found = sigmas(&end).expect("a system").expect("a small network");
        let unknowns = end.linear_system().expect("a system").unknowns;
        for point in &adjustment.points {
            for (axis, own) in ["X", "Y", "Z"].into_iter().zip(point.sigma.expect("a standard error")) {
                let name = format!("{} {axis}", point.id);
                let of_point = |one: &Unknown| one.point.as_ref() == Some(&point.id) && one.name == name;
                let k = unknowns.iter().position(of_point).expect("an unknown");
                assert!((found[k] / own - 1.0).abs() < 1e-6, "{name}: {} {own}", found[k]);
            }
        }
    }
}

#[test]
fn redundancy_numbers_are_those_of_the_adjustment() {
    let project = lab().expect("the lab net");
    let adjustment = adjust(&project, &options(), &mut |_| true).expect("a result");
    let names: Vec<String> = adjustment
        .observations
        .iter()
        .flat_map(|o| ["x", "y"].map(|axis| format!("r({} {} {axis})", o.photo, o.point)))
        .collect();
    let found = evaluate(&project, &options(), &names).expect("values");
    let own = adjustment.observations.iter().flat_map(|o| [o.rx, o.ry]);
    for (own, found) in own.zip(found) {
        assert!((own.expect("a redundancy number") - found.expect("a value")).abs() < 1e-6);
    }
}

#[test]
fn expressions_are_evaluated_and_faults_named() {
    let project = lab().expect("the lab net");
    let ask = |text: &str| evaluate(&project, &options(), &[text.to_owned()]).expect("a network").remove(0);
    assert_eq!(ask("n - u + d"), ask("redundancy"));
    assert_eq!(ask("-(2 + 3) * 4 / 8"), Ok(-2.5));
    assert_eq!(ask("without(5, photos)"), Ok(4.0));
    assert_eq!(ask("trace(free) < trace(minimal)"), Ok(1.0));
    assert_eq!(ask("datum_vtpv(free) = datum_vtpv(minimal)"), Ok(1.0));
    assert!((ask("r_sum").expect("a sum") - ask("redundancy").expect("a count")).abs() < 1e-6);
    for wrong in ["", "2 +", "(n", "nothing", "r(9 9 x)", "1 / 0", "n n"] {
        assert!(ask(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn datums_differ_in_their_ellipses_and_not_in_their_residuals() {
    let project = lab().expect("the lab net");
    let found = datums(&project, &options(), None).expect("datums");
    let of = |kind| found.cases.iter().find(|case| case.kind == kind).expect("a case");
    let (minimal, free) = (of(DatumKind::Minimal), of(DatumKind::Free));
    assert!((minimal.weighted_squares / free.weighted_squares - 1.0).abs() < 1e-9);
    assert!(free.trace < minimal.trace && of(DatumKind::Control).weighted_squares > free.weighted_squares);
    assert_eq!(found.motions.len(), 7);
    assert!(found.motions.iter().all(|motion| motion.seen < 1e-7));
}

#[test]
fn s_transformed_covariances_are_those_of_the_adjustment_under_the_other_datum() {
    use DatumKind::{Control, Free, Minimal};
    let project = lab().expect("the lab net");
    let held = ["2", "8", "11"].map(str::to_owned);
    for held in [None, Some(&held[..])] {
        for pair in [[Minimal, Free], [Free, Minimal]] {
            let found = transformed(&project, &options(), held, pair).expect("a result").expect("a small network");
            assert_eq!(found.points.len(), project.points.len());
            assert!(found.apart < 1e-9, "{pair:?}: {}", found.apart);
            // The datums differ, or there was nothing to transform.
            let changed = found.points.iter().map(|point| (point.before[0] / point.transformed[0] - 1.0).abs());
            assert!(changed.fold(0.0, f64::max) > 0.1);
        }
    }
    // Control adds observations, and its precision is not that of a free network.
    let found = transformed(&project, &options(), None, [Control, Free]).expect("a result").expect("a small network");
    assert!(found.apart > 1e-3);
    assert_eq!(transformed(&project, &options(), None, [Free, Control]), Ok(None));
    assert_eq!(transformed(&project, &options(), None, [Free, Free]), Ok(None));
}

#[test]
fn detection_rates_are_the_predicted_power() {
    let project = lab().expect("the lab net");
    for size in [0.0, 4.0, 8.0] {
        let found = plant(&project, &options(), &[Planting { observation: 20, axis: 0, size }]).expect("an answer");
        let (power, detected) = (found.power.expect("a power"), found.detected.expect("a share"));
        let spread = (power * (1.0 - power) / found.draws as f64).sqrt();
        assert!((power - detected).abs() <= 4.0 * spread, "{size} sigma: {power} {detected}");
        assert!(found.largest.expect("a share") <= detected);
        assert_eq!(found.estimates.len(), 4);
    }
}

#[test]
fn eccentricity_grows_with_the_square_of_the_diameter() {
    let project = lab().expect("the lab net");
    let found = biases(&project, &options(), &[10.0, 20.0]).expect("biases");
    assert!(found[0].largest > 0.0);
    assert!((found[1].largest / found[0].largest - 4.0).abs() < 0.01, "{found:?}");
}

#[test]
fn files_hold_the_same_solution() {
    let project = moved(&lab().expect("the lab net"), 0.001);
    let system = linearise(&project, &options()).expect("a system");
    let q = cofactors(&system).expect("a small network");
    let files = files(&project, &options()).expect("files");
    let read = |name: &str| -> Vec<f64> {
        let bytes = &files[name];
        let head = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        bytes[10 + head..].chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight"))).collect()
    };
    let a = DMatrix::from_row_slice(system.a.rows, system.a.columns, &read("A.npy"));
    assert_eq!(a, system.a.dense());
    let (x, v) = (DVector::from_vec(read("x.npy")), DVector::from_vec(read("v.npy")));
    assert!((&a * x - DVector::from_row_slice(&system.l) - v).amax() < 1e-12);
    let scale = |k: usize| q[(k, k)].sqrt();
    let n = DMatrix::from_row_slice(a.ncols(), a.ncols(), &read("N.npy"));
    let product = DMatrix::from_row_slice(a.ncols(), a.ncols(), &read("Qxx.npy")) * n;
    let far = (0..a.ncols()).flat_map(|i| (0..a.ncols()).map(move |j| (i, j)));
    let far = far.map(|(i, j)| (product[(i, j)] - f64::from(u8::from(i == j))).abs() * scale(j) / scale(i));
    assert!(far.fold(0.0, f64::max) < 1e-8);
}

#[test]
fn every_question_of_the_lessons_has_one_answer() {
    let lessons = lessons();
    assert_eq!(lessons.len(), 8);
    for lesson in lessons {
        let network = lesson.project.clone().unwrap_or_else(|| lab().expect("the lab net"));
        let mut off = 0.0;
        for words in lesson.all_words() {
            assert!(words.contains_key("en") && words.contains_key("ko"), "{}: {words:?}", lesson.id);
        }
        for (k, step) in lesson.steps.iter().enumerate() {
            off = step.show.moved.unwrap_or(off);
            let project = moved(&network, off);
            let texts = step.expressions();
            let values = evaluate(&project, &options(), &texts).expect("a network");
            let value = |text: &str| {
                let at = texts.iter().position(|one| one == text).expect("an expression of the step");
                values[at].clone().unwrap_or_else(|error| panic!("{} {}: {error}", lesson.id, k + 1))
            };
            for text in &texts {
                println!("{} {}: {text} = {}", lesson.id, k + 1, value(text));
            }
            let Some(ask) = &step.ask else { continue };
            match &ask.value {
                Some(text) => assert!(value(text).is_finite()),
                None => {
                    let right = ask.choices.iter().filter(|choice| value(&choice.when) != 0.0).count();
                    assert_eq!(right, 1, "{} {}: {right} choices are right", lesson.id, k + 1);
                }
            }
            let rows = linearise(&project, &options()).expect("a system").observations;
            assert!(step.show.observation.iter().all(|name| rows.iter().any(|row| row.name == *name)));
        }
    }
}

#[test]
fn damaged_lessons_are_refused_with_a_reason() {
    let text = serde_json::to_string(&lessons()[0]).expect("JSON");
    assert_eq!(Lesson::read(&text).as_ref(), Ok(&lessons()[0]));
    let changed = |from: &str, to: &str| Lesson::read(&text.replacen(from, to, 1)).expect_err("damaged");
    assert!(changed("sightline-lesson", "other").contains("format"));
    assert!(changed("\"weights\"", "\"a b\"").contains("id"));
    assert!(changed("\"tolerance\"", "\"tolerence\"").contains("tolerence"));
    assert!(changed(",\"tolerance\":0.0", "").contains("step 1"));
    assert!(Lesson::read("").is_err());
}

#[test]
fn progress_comes_back_from_its_file() {
    let reached = Reached { step: 2, right: [0, 1].into() };
    let progress = LessonProgress::new(Some("datum".to_owned()), [("datum".to_owned(), reached)].into());
    let text = progress.text();
    assert_eq!(LessonProgress::read(&text), Some(Ok(progress)));
    // Lessons and other files are of another format.
    assert_eq!(LessonProgress::read(r#"{"format": "sightline-lesson"}"#), None);
    assert_eq!(LessonProgress::read("no JSON"), None);
    assert!(LessonProgress::read(&text.replace("\"version\": 1", "\"version\": 2")).is_some_and(|read| read.is_err()));
    assert!(LessonProgress::read(&text.replace("\"step\": 2", "\"step\": -1")).is_some_and(|read| read.is_err()));
}
