//! The project format as other programs write it.

use sightline::project::{DatumKind, Interior, Parameter, Project, Role, Sigma};

const FOREIGN: &str = r#"{
  "format": "sightline", "version": 1, "name": "n", "unit": "m", "later": true,
  "cameras": [
    { "id": 1, "width": 10, "height": 8, "pixel_pitch": null, "model": "brown", "c": 12.5, "x0": 0, "free": ["c", "k1"], "sigma": { "x0": 0.1 } },
    { "id": "b", "width": 10, "height": 8, "model": "opencv", "fx": 12.5, "fy": 12.5, "cx": 5, "cy": 4, "free": ["f"] }
  ],
  "photos": [{ "id": 7, "camera": 1, "file": "a.png", "position": [1, 2, 3], "rotation": null }],
  "points": [{ "id": 1001, "role": "control", "xyz": [0, 0, 0], "sigma": [0.1, null, 0] }],
  "observations": [{ "photo": 7, "point": 1001, "u": 1.5, "v": 2, "sigma": [0.1, 0.2] }],
  "datum": { "kind": "minimal", "points": [1001] }
}"#;

#[test]
fn documents_of_other_programs_are_read_and_survive() {
    let project: Project = serde_json::from_str(FOREIGN).expect("a valid document");
    assert_eq!(project.cameras[0].id, "1");
    assert_eq!(project.cameras[0].interior.get(Parameter::C), Some(12.5));
    assert_eq!(project.cameras[0].estimated(), [Parameter::C, Parameter::X0, Parameter::K1]);
    assert!(matches!(project.cameras[1].interior, Interior::Opencv { cx: 5.0, .. }));
    assert!(project.photos[0].enabled && project.observations[0].enabled);
    assert_eq!(project.points[0].role, Role::Control);
    assert_eq!(project.observations[0].sigma, Sigma::Two([0.1, 0.2]));
    assert_eq!(project.datum.kind, DatumKind::Minimal);
    assert_eq!(project.datum.points.as_deref(), Some(&["1001".to_string()][..]));
    let text = serde_json::to_string(&project).expect("serialisable");
    assert_eq!(serde_json::from_str::<Project>(&text).expect("its own text"), project);
}
