#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;

const DESCRIPTION: &str = "camera, p31\nc, 100\nplate 120 100\nsigma; 0.002\ntransformation, similarity\n\
    fiducial, F1, -50, 40\nfiducial, F2, 50, 40\nfiducial, F3, 50, -40\nfiducial, F4, -50, -40\n\
    # radius and displacement\ndistortion 10 1\ndistortion 20 6\ndistortion 30 12\ndistortion 40 17\n\
    control, 7, 1, 2, 3, 0.001\n";
/// The machine's origin lies at 200, 100 and it is not turned.
const READINGS: &str =
    "photo,mark,x,y\n01,F1,150,140\n01,F2,250,140\n01,F3,250,60\n01,F4,150,60\n01,7,212,95\n01,8,201,100\n";

fn files(texts: &[(&str, &str)]) -> Files {
    texts.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())).collect()
}

#[test]
fn a_description_and_readings_make_a_project() {
    let reduced = import(&files(&[("camera.txt", DESCRIPTION), ("readings.csv", READINGS)])).unwrap();
    let project = &reduced.project;
    project.validate().unwrap();
    assert_eq!((project.photos.len(), project.points.len(), project.observations.len()), (1, 2, 2));
    let (camera, first) = (&project.cameras[0], &project.observations[0]);
    let [x, y] = camera.photo_from_pixel([first.u, first.v]);
    assert!((x - 12.0).abs() < 1e-9 && (y + 5.0).abs() < 1e-9, "{x} {y}");
    assert!((first.sigma.both()[0] * PITCH_MM - 0.002).abs() < 1e-12);
    assert_eq!((project.points[0].role, project.points[0].xyz), (Role::Control, Some([1.0, 2.0, 3.0])));
    assert_eq!(project.datum.kind, DatumKind::Control);
    let table = reduced.distortion.expect("a table");
    // What was displaced outwards is corrected inwards.
    assert!(camera.interior.get(Parameter::K1).unwrap() < 0.0 && table.polynomial.residuals.len() == 4);
    assert_eq!(reduced.inner_orientations[0].marks.len(), 4);
}

#[test]
fn readings_with_any_separator_are_read() {
    for text in [
        "photo,mark,x,y\n# machine\n01,F1,1.5,2\n01,7,-3,4e1\n",
        "01;F1;1.5;2\n\n01;7;-3;40",
        "01 F1 1.5 2\n01  7\t-3 40\n",
        "01,F1,1.5,2\n\"01\",\"7\",-3,40",
    ] {
        let (_, readings) = parse(text).unwrap();
        assert_eq!(readings.len(), 2, "{text}");
        assert_eq!((readings[1].mark.as_str(), readings[1].x, readings[1].y), ("7", -3.0, 40.0));
    }
    assert_eq!(parse("01,F1,1,2\n01,F2,1\n").expect_err("short").place().line, Some(2));
}

#[test]
fn one_file_holds_both_and_a_scan_points_down() {
    let flipped =
        READINGS.replace("140\n", "60_\n").replace(",60\n", ",140\n").replace("60_", "60").replace(",95", ",105");
    let both = format!("{DESCRIPTION}y, down\n{flipped}");
    let project = import(&files(&[("all.txt", &both)])).unwrap().project;
    let o = &project.observations[0];
    let [x, y] = project.cameras[0].photo_from_pixel([o.u, o.v]);
    assert!((x - 12.0).abs() < 1e-9 && (y + 5.0).abs() < 1e-9, "{x} {y}");
    // The same, measured in the photos of a project.
    let scanned = Project {
        observations: parse(&flipped)
            .unwrap()
            .1
            .into_iter()
            .map(|r| sightline::project::Observation {
                photo: r.photo,
                point: r.mark,
                u: r.x,
                v: r.y,
                sigma: sightline::project::Sigma::One(0.1),
                enabled: true,
                target: None,
            })
            .collect(),
        ..Project::default()
    };
    let (description, _) = parse(&format!("{DESCRIPTION}y, down\n")).unwrap();
    assert_eq!(reduce(&description, &readings_of(&scanned)).unwrap().project, project);
}

#[test]
fn other_texts_are_not_taken_for_plates() {
    assert!(comparator_files(DESCRIPTION) && !comparator_files(READINGS) && !comparator_files("id,X,Y,Z\n1,2,3,4\n"));
}

fn comparator_files(text: &str) -> bool {
    recognises(&files(&[("a.txt", text)]))
}

#[test]
fn faults_name_file_line_and_field() {
    let fault = |text: &str| import(&files(&[("camera.txt", text)])).unwrap_err();
    assert_eq!(fault(READINGS).code(), "empty");
    assert_eq!(fault(DESCRIPTION).code(), "empty");
    let error = fault(&format!("{DESCRIPTION}01,F1,150\n"));
    assert_eq!((error.place().line, error.place().field.as_deref()), (Some(16), Some("y")));
    assert_eq!(error.place().file.as_deref(), Some("camera.txt"));
    for wrong in ["c, -1", "transformation, round", "y, left", "fiducial, F1, 0, 0", "sigma, nan"] {
        assert!(matches!(fault(&format!("{DESCRIPTION}{wrong}\n")).place().line, Some(16)), "{wrong}");
    }
    // Four fits three terms, two do not.
    let few = DESCRIPTION.replace("distortion 30 12\ndistortion 40 17\n", "");
    assert_eq!(fault(&format!("{few}{READINGS}")).code(), "invalid");
}

#[test]
fn numbers_beyond_all_measure_are_refused_and_no_infinity_comes_out() {
    let numbers = |text: &str| text.split([' ', ',', ';', '\n']).filter(|f| text::number(f).is_some()).count();
    let mut seen = 0;
    for (which, source) in [DESCRIPTION, READINGS].into_iter().enumerate() {
        for place in 0..numbers(source) {
            for huge in ["1e308", "-1e308", "1e160", "1e12"] {
                let mut count = 0;
                let replaced: String = source
                    .split_inclusive([' ', ',', ';', '\n'])
                    .map(|piece| {
                        let field = piece.trim_end_matches([' ', ',', ';', '\n']);
                        if text::number(field).is_none() {
                            return piece.to_owned();
                        }
                        count += 1;
                        if count == place + 1 { piece.replace(field, huge) } else { piece.to_owned() }
                    })
                    .collect();
                let texts = if which == 0 { [&replaced, READINGS] } else { [DESCRIPTION, &replaced] };
                let Ok(reduced) = import(&files(&[("camera.txt", texts[0]), ("readings.csv", texts[1])])) else {
                    seen += 1;
                    continue;
                };
                let written = format!("{reduced:?}");
                let infinite = written.split(|c: char| !c.is_alphanumeric()).any(|word| ["inf", "NaN"].contains(&word));
                assert!(!infinite, "{huge} at {place} of {which}: {written}");
            }
        }
    }
    assert!(seen > 100, "{seen}");
}
