//! Nothing that is given is left out in silence: mistakes of random networks are named in the notes of the orientation, in the advice and
//! the list of the adjustment, and in the report's summary.

use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, Adjustment, Advice, LeftOutBy, LeftOutKind, LeftOutReason};
use sightline::noise::Noise;
use sightline::orient::{Note, Oriented, PointReason, orient};
use sightline::project::{DatumKind, Project, SetAside, SetAsideBy, SetAsideReason};
use sightline::{Error, Result};
use sightline_report::report;

use crate::support::networks::{Uniform, Wanted, brown, exact, noisy};

/// A network with control that is measured, without anything that an orientation finds.
fn network(control: (usize, f64), seed: u64) -> Project {
    let wanted = Wanted {
        photos: 6,
        points: 30,
        cameras: vec![brown(&[])],
        datum: DatumKind::Control,
        control,
        ..Wanted::default()
    };
    let mut project = noisy(&exact(&wanted, seed), &mut Noise::new(seed, 0));
    for photo in &mut project.photos {
        (photo.position, photo.rotation) = (None, None);
    }
    project.points.iter_mut().skip(control.0).for_each(|point| point.xyz = None);
    project
}

fn solved(project: &Project) -> (Oriented, Result<Adjustment>) {
    let oriented = orient(project).expect("a sound document");
    let adjustment = adjust(&oriented.project, &AdjustOptions::default(), &mut |_| true);
    (oriented, adjustment)
}

fn misfits(notes: &[Note]) -> Vec<(&str, [f64; 3], f64)> {
    notes
        .iter()
        .filter_map(|note| match note {
            Note::ControlMisfit { point, difference, sigma_ratio } => Some((point.as_str(), *difference, *sigma_ratio)),
            _ => None,
        })
        .collect()
}

fn advised(adjustment: &Adjustment) -> Vec<&str> {
    let named = adjustment.advice.iter().filter_map(|advice| match advice {
        Advice::ControlMisfit { point, .. } => Some(point.as_str()),
        _ => None,
    });
    named.collect()
}

/// The report's summary, without its tags.
fn summary(oriented: &Oriented, adjustment: &Adjustment) -> String {
    let body = report(&oriented.project, Some(adjustment)).expect("a report").body;
    let from = body.find("data-section=\"summary\"").expect("a summary");
    let length = body[from..].find("</section>").expect("its end");
    body[from..from + length].to_owned()
}

#[test]
fn a_typo_in_a_control_coordinate_is_named_whatever_its_size() {
    for (seed, control) in [(1, 0.1), (2, 0.0), (3, 0.1), (4, 0.0), (5, 0.05), (6, 0.0)] {
        let mut random = Uniform(seed);
        let (k, axis) = (random.between(0.0, 8.0) as usize, random.between(0.0, 3.0) as usize);
        for size in [1.0, -30.0] {
            let case = format!("seed {seed}, {control}, p{k} {axis}, {size}");
            let mut project = network((8, control), seed);
            project.points[k].xyz.as_mut().expect("given")[axis] += size;
            let id = project.points[k].id.clone();
            let (oriented, adjustment) = solved(&project);
            let adjustment = adjustment.expect("solvable");
            let found = misfits(&oriented.notes);
            assert_eq!(found.len(), 1, "{case}: {found:?}");
            let (point, difference, ratio) = found[0];
            assert!(point == id && ratio > 4.0, "{case}: {found:?}");
            assert!((difference[axis] - size).abs() < 0.6, "{case}: {found:?}");
            assert_eq!(advised(&adjustment), [id.as_str()], "{case}");
            assert!(summary(&oriented, &adjustment).contains(&format!("Control point {id} is ")), "{case}");
            let options = AdjustOptions { snooping: true, ..AdjustOptions::default() };
            let snooped = adjust(&oriented.project, &options, &mut |_| true).expect("solvable");
            let own = snooped.left_out.iter().filter(|item| item.point.as_ref() == Some(&id));
            assert!(own.count() > 0, "{case}: {:?}", snooped.left_out);
            assert!(summary(&oriented, &snooped).contains("Not used: "), "{case}");
            if size < -10.0 {
                let out = adjustment.left_out.iter().find(|item| item.kind == LeftOutKind::Control);
                let out = out.unwrap_or_else(|| panic!("{case}: {:?}", adjustment.left_out));
                assert_eq!((out.point.as_ref(), out.by), (Some(&id), LeftOutBy::Orientation), "{case}");
                assert!((out.size.unwrap_or_default() + size).abs() < 1.0, "{case}: {out:?}");
                assert!(out.size_sigma.unwrap_or_default() > 50.0, "{case}: {out:?}");
                assert!(summary(&oriented, &adjustment).contains("1 of 8 control points"), "{case}");
            }
        }
    }
}

#[test]
fn exchanged_and_mirrored_control_points_are_named() {
    for seed in 11..17 {
        let mut random = Uniform(seed);
        let mut project = network((8, if seed % 2 == 0 { 0.1 } else { 0.0 }), seed);
        let a = random.between(0.0, 8.0) as usize;
        let b = (a + 1 + random.between(0.0, 7.0) as usize) % 8;
        let mut mirrored = project.clone();
        let places = [project.points[a].xyz, project.points[b].xyz];
        [project.points[b].xyz, project.points[a].xyz] = places;
        let (oriented, adjustment) = solved(&project);
        let adjustment = adjustment.expect("solvable");
        let mut names = [a, b].map(|k| project.points[k].id.clone());
        names.sort();
        let exchanged = |points: &[String; 2]| {
            let mut points = points.clone();
            points.sort();
            points == names
        };
        let noted = oriented.notes.iter().any(|n| matches!(n, Note::ExchangedPoints { points } if exchanged(points)));
        assert!(noted, "seed {seed}: {:?}", oriented.notes);
        assert!(misfits(&oriented.notes).is_empty(), "seed {seed}");
        let advice = adjustment.advice.iter();
        let told = |a: &Advice| matches!(a, Advice::ExchangedPoints { points } if exchanged(points));
        assert_eq!(advice.filter(|a| told(a)).count(), 1, "seed {seed}: {:?}", adjustment.advice);
        let out = adjustment.left_out.iter().filter(|item| item.kind == LeftOutKind::Control).count();
        assert_eq!(out, 2, "seed {seed}");
        let summary = summary(&oriented, &adjustment);
        assert!(summary.contains("seem exchanged") && summary.contains("2 of 8 control points"), "seed {seed}");

        let x = &mut mirrored.points[a].xyz.as_mut().expect("given")[0];
        *x = -*x - 20.0_f64.copysign(*x);
        let (oriented, adjustment) = solved(&mirrored);
        let found = misfits(&oriented.notes);
        assert_eq!(
            found.iter().map(|found| found.0).collect::<Vec<_>>(),
            [mirrored.points[a].id.as_str()],
            "seed {seed}"
        );
        let adjustment = adjustment.expect("solvable");
        assert_eq!(advised(&adjustment), [mirrored.points[a].id.as_str()], "seed {seed}");
    }
}

#[test]
fn right_networks_have_nothing_left_out_and_no_word_against_control() {
    for seed in 21..33 {
        // Control of a millimetre is three times as uncertain as the photos.
        let sigma = [0.0, 0.1, 1.0][seed as usize % 3];
        let (oriented, adjustment) = solved(&network((8, sigma), seed));
        let adjustment = adjustment.expect("solvable");
        assert!(misfits(&oriented.notes).is_empty(), "seed {seed}, {sigma}: {:?}", misfits(&oriented.notes));
        assert!(advised(&adjustment).is_empty(), "seed {seed}, {sigma}");
        assert_eq!(adjustment.left_out, [], "seed {seed}, {sigma}");
        assert!(summary(&oriented, &adjustment).contains("All measurements were used"), "seed {seed}");
    }
}

#[test]
fn a_wrong_name_is_listed_with_its_photo_and_size() {
    for seed in 41..49 {
        let mut random = Uniform(seed);
        let mut project = network((8, 0.1), seed);
        let photo = format!("f{}", random.between(0.0, 6.0) as usize);
        let (a, b) = (8 + random.between(0.0, 11.0) as usize, 19 + random.between(0.0, 11.0) as usize);
        let at = |project: &Project, k: usize| {
            let id = format!("p{k}");
            project.observations.iter().position(|o| o.photo == photo && o.point == id).expect("measured")
        };
        let (wrong, other) = (at(&project, a), at(&project, b));
        let place = [project.observations[other].u, project.observations[other].v];
        let far = (place[0] - project.observations[wrong].u).hypot(place[1] - project.observations[wrong].v);
        [project.observations[wrong].u, project.observations[wrong].v] = place;
        project.observations.remove(other);
        let (oriented, adjustment) = solved(&project);
        let adjustment = adjustment.expect("solvable");
        let item = adjustment.left_out.iter().find(|item| item.kind == LeftOutKind::Observation);
        let item = item.unwrap_or_else(|| panic!("seed {seed}: {:?}", oriented.notes));
        assert_eq!((item.photo.as_deref(), item.point.clone()), (Some(photo.as_str()), Some(format!("p{a}"))));
        assert_eq!((item.by, item.reason), (LeftOutBy::Orientation, LeftOutReason::Disagrees), "seed {seed}");
        assert!((item.size_px.unwrap_or_default() / far - 1.0).abs() < 0.05, "seed {seed}: {item:?}, {far}");
        assert!(item.size_sigma.unwrap_or_default() > 50.0, "seed {seed}: {item:?}");
        let summary = summary(&oriented, &adjustment);
        assert!(summary.contains(&format!("p{a} – {photo} (")), "seed {seed}: {summary}");
        assert!(summary.contains("1 of 179 image observations"), "seed {seed}: {summary}");
    }
}

#[test]
fn too_little_control_that_agrees_is_an_error_with_names() {
    for seed in 51..55 {
        let mut random = Uniform(seed);
        let mut project = network((7, 0.1), seed);
        for point in project.points.iter_mut().take(4) {
            let xyz = point.xyz.as_mut().expect("given");
            xyz.iter_mut().for_each(|x| *x += random.between(30.0, 200.0) * random.between(-1.0, 1.0).signum());
        }
        let (_, adjustment) = solved(&project);
        let Err(Error::ControlDisagrees { agreeing, disagreeing }) = adjustment else {
            panic!("seed {seed}: {:?}", adjustment.map(|a| a.left_out))
        };
        assert!(agreeing.len() < 4, "seed {seed}: {agreeing:?}");
        let told = Error::ControlDisagrees { agreeing, disagreeing: disagreeing.clone() }.to_string();
        // A sentence names five and counts the rest.
        assert!(disagreeing.iter().take(5).all(|id| told.contains(id)), "{told}");
    }
}

#[test]
fn a_tie_of_two_places_is_set_aside_and_asked() {
    for seed in 61..67 {
        let mut project = network((8, 0.1), seed);
        // Two names exchanged in two of the four photos that show them.
        let ids = ["p20", "p25"];
        let seen = |o: &sightline::project::Observation| {
            !ids.contains(&o.point.as_str()) || ["f0", "f1", "f2", "f3"].contains(&o.photo.as_str())
        };
        project.observations.retain(seen);
        for o in project.observations.iter_mut().filter(|o| ["f1", "f2"].contains(&o.photo.as_str())) {
            if let Some(k) = ids.iter().position(|id| *id == o.point) {
                o.point = ids[1 - k].into();
            }
        }
        let (oriented, adjustment) = solved(&project);
        let adjustment = adjustment.expect("solvable");
        for id in ids {
            let asked = oriented.notes.iter().any(|note| {
                matches!(note, Note::PointNotDetermined { point, reason: PointReason::Undecided { first, second } }
                    if point == id && first.len() == 2 && second.len() == 2)
            });
            assert!(asked, "seed {seed}, {id}: {:?}", oriented.notes);
            let own = adjustment
                .left_out
                .iter()
                .filter(|item| item.kind == LeftOutKind::Observation && item.point.as_deref() == Some(id));
            let own: Vec<_> = own.collect();
            assert!(own.len() == 4 && own.iter().all(|item| item.reason == LeftOutReason::Undecided), "{own:?}");
            assert!(adjustment.points.iter().all(|point| point.id != id), "seed {seed}");
        }
        assert!(adjustment.global_test.as_ref().is_some_and(|test| test.statistic < test.upper), "seed {seed}");
    }
}

#[test]
fn what_was_set_aside_and_fits_is_taken_back_and_what_is_wrong_is_not() {
    for seed in 71..77 {
        let mut random = Uniform(seed);
        let mut project = orient(&network((8, 1.0), seed)).expect("a sound document").project;
        let mut rows: Vec<usize> = (0..5).map(|_| random.between(0.0, 90.0) as usize).collect();
        let wrong = 90 + random.between(0.0, 90.0) as usize;
        rows.extend([wrong]);
        rows.sort_unstable();
        rows.dedup();
        project.observations[wrong].u += 3.0;
        for &row in &rows {
            let o = &mut project.observations[row];
            o.enabled = false;
            let (photo, point) = (o.photo.clone(), o.point.clone());
            let reason = SetAsideReason::Disagrees;
            project.set_aside.push(SetAside { photo, point, reason, distance_px: None, by: SetAsideBy::Orientation });
        }
        let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        let [item] = &adjustment.left_out[..] else { panic!("seed {seed}: {:?}", adjustment.left_out) };
        let o = &project.observations[wrong];
        assert_eq!((item.photo.as_ref(), item.point.as_ref()), (Some(&o.photo), Some(&o.point)), "seed {seed}");
        assert!(item.size_sigma.is_some_and(|size| size > 8.0 && size < 20.0), "seed {seed}: {item:?}");
        assert_eq!(adjustment.gross_errors.len(), rows.len() - 1, "seed {seed}");
        assert!(adjustment.gross_errors.iter().all(|entry| entry.round == 0), "seed {seed}");
        let applied = apply(&project, &adjustment);
        assert_eq!(applied.set_aside.len(), 1, "seed {seed}");
        assert_eq!(applied.observations.iter().filter(|o| !o.enabled).count(), 1, "seed {seed}");
    }
}
