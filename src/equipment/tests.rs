//! Equipment read, written, joined, and what it gives a project.

use super::*;
use crate::adjustment::AdjustedCamera;
use crate::exif::PhotoInfo;
use crate::project::{Camera, Distance, Interior, Observation, Parameter, Photo, Point, Project, Sigma};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn info() -> PhotoInfo {
    PhotoInfo {
        make: Some("NIKON CORPORATION".into()),
        model: Some("NIKON D5600".into()),
        focal_length_mm: Some(35.0),
        ..PhotoInfo::default()
    }
}

fn calibration(date: &str, c: f64) -> Calibration {
    Calibration {
        date: date.into(),
        pixel_pitch: Some([0.0039; 2]),
        interior: Interior::brown(c),
        sigma: [(Parameter::C, 0.002), (Parameter::K1, 3e-7)].into(),
        remark: String::new(),
        origin: None,
    }
}

fn camera(id: &str) -> KnownCamera {
    KnownCamera {
        id: id.into(),
        make: info().make,
        model: info().model,
        focal_length_mm: Some(35.0),
        width: 6000,
        height: 4000,
        calibrations: vec![calibration("2026-05-01", 35.3)],
    }
}

fn bar(id: &str, from: &str, to: &str) -> ScaleBar {
    ScaleBar {
        id: id.into(),
        from: from.into(),
        to: to.into(),
        length: 1.000_012,
        sigma: 0.000_004,
        unit: "m".into(),
        certificate: "C 4711".into(),
        date: "2025-11-30".into(),
    }
}

fn equipment() -> Equipment {
    Equipment { cameras: vec![camera("D5600")], bars: vec![bar("A", "11", "12")], ..Equipment::default() }
}

#[test]
fn what_is_written_is_read_again() {
    let text = equipment().write().unwrap();
    assert!(Equipment::is_claimed_by(text.as_bytes()));
    assert_eq!(Equipment::read(&text).unwrap(), equipment());
    let utf16 =
        |bytes: fn(u16) -> [u8; 2]| format!("\u{feff}{text}").encode_utf16().flat_map(bytes).collect::<Vec<_>>();
    for encoded in [utf16(u16::to_le_bytes), utf16(u16::to_be_bytes)] {
        assert!(Equipment::is_claimed_by(&encoded[..HEAD.min(encoded.len())]));
    }
    assert!(!Equipment::is_claimed_by(b"{\"format\":\"sightline\"}") && !Equipment::is_claimed_by(b"no"));
}

#[test]
fn what_is_no_equipment_or_damaged_is_told_with_its_place() {
    let told = |text: &str| Equipment::read(text).unwrap_err().to_string();
    assert!(told("1 2 3").contains("not a Sightline equipment file"));
    assert!(told("{\"format\":\"sightline\",\"version\":1}").contains("not a Sightline equipment file"));
    let text = equipment().write().unwrap();
    assert!(told(&text.replace("\"version\": 1", "\"version\": 7")).contains('7'));
    assert!(told(&text[..text.len() / 2]).contains("not a Sightline equipment file"));
    type Fault = fn(&mut Equipment);
    let faults: [(Fault, &str); 11] = [
        (|e| e.cameras.push(e.cameras[0].clone()), "D5600"),
        (|e| e.bars.push(e.bars[0].clone()), "A"),
        (|e| e.cameras[0].width = 0, "width"),
        (|e| e.cameras[0].calibrations[0].interior = Interior::brown(-1.0), "c"),
        (|e| e.cameras[0].calibrations[0].pixel_pitch = Some([0.0; 2]), "pixel_pitch"),
        (|e| e.cameras[0].calibrations[0].sigma = [(Parameter::Fx, 1.0)].into(), "D5600"),
        (|e| e.cameras[0].calibrations[0].sigma = [(Parameter::C, -1.0)].into(), "c"),
        (|e| e.bars[0].length = 0.0, "bars: A"),
        (|e| e.bars[0].sigma = f64::NAN, "bars: A"),
        (|e| e.bars[0].to = "11".into(), "bars: A"),
        (|e| e.bars[0].unit = " ".into(), "bars: A"),
    ];
    for (k, (fault, place)) in faults.into_iter().enumerate() {
        let mut broken = equipment();
        fault(&mut broken);
        let error = broken.validate().expect_err("a fault");
        assert!(error.to_string().contains(place), "fault {k}: {error}");
        assert!(broken.write().is_err());
    }
}

#[test]
fn a_camera_is_known_again_by_model_focal_length_and_grid() {
    let known = camera("D5600");
    let size = [6000, 4000];
    assert!(known.took(&info(), size));
    assert!(known.took(&PhotoInfo { model: Some(" nikon d5600 ".into()), ..info() }, size));
    assert!(known.took(&PhotoInfo { focal_length_mm: Some(35.1), ..info() }, size));
    assert!(!known.took(&PhotoInfo { focal_length_mm: Some(50.0), ..info() }, size));
    assert!(!known.took(&PhotoInfo { focal_length_mm: None, ..info() }, size));
    assert!(!known.took(&PhotoInfo { model: Some("NIKON D750".into()), ..info() }, size));
    assert!(!known.took(&info(), [4000, 6000]) && !known.took(&PhotoInfo::default(), size));
    // Without a model nothing is known again by its photos, and only its name tells it from others.
    let nameless = KnownCamera { model: None, make: None, ..known.clone() };
    assert!(!nameless.took(&PhotoInfo { model: None, make: None, ..info() }, size));
    assert!(nameless.is_same(&nameless) && !nameless.is_same(&KnownCamera { id: "x".into(), ..nameless.clone() }));
    assert!(known.is_same(&camera("another name")) && !known.is_same(&nameless));
}

#[test]
fn joining_adds_and_replaces_and_takes_nothing_away() {
    let mut all = equipment();
    assert_eq!(all.join(equipment()), Joined::default());
    let mut other = equipment();
    other.cameras[0].calibrations = vec![calibration("2025-01-01", 35.2), calibration("2026-05-01", 35.3)];
    other.cameras.push(KnownCamera { focal_length_mm: Some(50.0), ..camera("D5600") });
    other.cameras[1].calibrations.push(calibration("2026-06-01", 50.1));
    other.bars = vec![ScaleBar { length: 1.5, ..bar("A", "11", "12") }, bar("B", "13", "14")];
    assert_eq!(all.join(other), Joined { cameras: 1, calibrations: 3, bars: 2 });
    assert_eq!(all.cameras.iter().map(|c| c.id.as_str()).collect::<Vec<_>>(), ["D5600", "D5600 2"]);
    let dates = all.cameras[0].calibrations.iter().map(|c| c.date.as_str()).collect::<Vec<_>>();
    assert_eq!(dates, ["2025-01-01", "2026-05-01"]);
    assert_eq!((all.bars.len(), all.bars[0].length), (2, 1.5));
    all.validate().expect("sound");
}

#[test]
fn a_calibration_is_held_observed_or_a_start() {
    let mut project = Camera::new("k", 6000, 4000, Interior::brown(1.0));
    project.free = Parameter::BROWN.to_vec();
    let calibration = calibration("2026-05-01", 35.3);
    let uses = [(Use::Held, 0, 0), (Use::Observed, 2, 2), (Use::Free, 2, 0)];
    for (how, free, observed) in uses {
        calibration.apply(&mut project, how);
        assert_eq!((project.free.len(), project.sigma.len()), (free, observed), "{how:?}");
        assert_eq!((project.interior, project.pixel_pitch), (calibration.interior, Some([0.0039; 2])));
        assert_eq!(project.id, "k");
    }
    let adjusted = AdjustedCamera {
        camera: project,
        photo: None,
        sigma: [(Parameter::C, 0.01), (Parameter::X0, 0.0)].into(),
        significance: Default::default(),
        correlation: Default::default(),
    };
    let known = KnownCamera::adjusted(&adjusted, &info(), "2026-07-01");
    assert_eq!(known.latest().unwrap().sigma, [(Parameter::C, 0.01)].into());
    assert!(known.took(&info(), [6000, 4000]) && known.validate().is_ok());
}

/// A project with points measured in photos.
fn project(seen: &[(&str, &[&str])]) -> Project {
    let observation = |point: &str, photo: &str| Observation {
        photo: photo.into(),
        point: point.into(),
        u: 1.0,
        v: 1.0,
        sigma: Sigma::One(0.1),
        enabled: true,
        target: None,
    };
    Project {
        photos: ["a", "b", "c"]
            .map(|id| Photo { id: id.into(), camera: "k".into(), enabled: id != "c", ..Photo::default() })
            .into(),
        points: seen.iter().map(|(id, _)| Point { id: (*id).into(), ..Point::default() }).collect(),
        observations: seen.iter().flat_map(|(id, photos)| photos.iter().map(|p| observation(id, p))).collect(),
        unit: "mm".into(),
        ..Project::default()
    }
}

#[test]
fn a_bar_gives_its_distance_where_both_ends_are_seen_twice() {
    let bars = [bar("A", "11", "12"), bar("B", "13", "14")];
    let both: &[&str] = &["a", "b"];
    let mut p = project(&[("11", both), ("12", both), ("13", both), ("14", &["a", "c"])]);
    let found = bars_in(&bars, &p);
    assert_eq!(found.iter().map(|(bar, _)| bar.id.as_str()).collect::<Vec<_>>(), ["A"]);
    assert!((found[0].1.length - 1000.012).abs() < 1e-9 && (found[0].1.sigma - 0.004).abs() < 1e-12);
    p.unit = "ell".into();
    assert!(bars_in(&bars, &p).is_empty());
    p.unit = "mm".into();
    p.distances.push(Distance { from: "12".into(), to: "11".into(), length: 1.0, sigma: 1.0, check: true });
    assert!(bars_in(&bars, &p).is_empty());
    p.distances.clear();
    p.observations[0].enabled = false;
    assert!(bars_in(&bars, &p).is_empty());
}

#[test]
fn lateral_colour_of_an_earlier_version_is_named_in_the_origin_of_its_calibration() {
    let mut known = equipment();
    known.cameras[0].keep(calibration("2026-06-01", 35.2));
    let text = known.write().expect("text");
    let at = text.rfind("\"sigma\": {").expect("a calibration's sigma");
    let set = r#""colours": {"red": {"parameters": {"c": 0.01}}}, "#;
    let read = Equipment::read(&format!("{}{set}{}", &text[..at], &text[at..]));
    let [plain, earlier] = &read.expect("equipment").cameras[0].calibrations[..] else { panic!("two calibrations") };
    assert_eq!(plain.origin, None);
    let origin = earlier.origin.as_deref().expect("an origin");
    assert!(!origin.is_foreign() && origin.ignored[0].name == RemovedFields::OF_CAMERAS);
    let calibration = Calibration { origin: None, ..earlier.clone() };
    assert_eq!(calibration, known.cameras[0].calibrations[1]);
}
