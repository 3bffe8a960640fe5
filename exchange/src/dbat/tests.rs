//! A small project in DBAT's form.

use super::*;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const SCRIPT: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<document dbat_script_version="1.0">
  <meta><name>Test &amp; more</name><project_unit>m</project_unit></meta>
  <input base_dir="$HERE">
    <ctrl_pts><file format="id,label,x,y,z,sx,sy,sz">ref/control.txt</file><filter id="3">remove</filter></ctrl_pts>
    <check_pts><file format="id,label,x,y,z,sx,sy,sz">ref/control.txt</file><filter id="3">keep</filter></check_pts>
    <images><file format="id,path">images.txt</file></images>
    <image_pts><file format="id,im,x,y" sxy="0.5">marks.txt</file></image_pts>
    <cameras><camera>
      <sensor>20,10</sensor><image>2000,1000</image><cc>12.5</cc><pp>10.5,4.9</pp><K>1,2,3</K><P>4,5</P><model>3</model><skew>0</skew><aspect>1</aspect>
    </camera></cameras>
  </input>
  <operations>
    <operation min_rays="2">check_ray_count</operation>
    <operation><set_bundle_estimate_params><io>false</io></set_bundle_estimate_params></operation>
  </operations>
</document>"#;

fn files(script: &str) -> Files {
    let text = |text: &str| text.as_bytes().to_vec();
    Files::from([
        ("job/test.xml".into(), text(script)),
        ("control.txt".into(), text("# id\n1, A, 10, 20, 30, .1, .2, .3\n3, C, 1, 2, 3, 1, 1, 1\n")),
        ("images.txt".into(), text("1, some/where/a.jpg\n2, b.jpg\n")),
        ("marks.txt".into(), text("1, 1, 10.5, 20.5\n8, 1, 3, 4\n8, 2, 5, 6\n9, 1, 7, 8\n")),
    ])
}

#[test]
fn a_project_is_put_together_from_its_files() {
    let project = import(&files(SCRIPT)).unwrap();
    assert_eq!((project.name.as_str(), project.unit.as_str()), ("Test & more", "m"));
    assert_eq!(project.cameras[0].pixel_pitch, Some([0.01, 0.01]));
    let Interior::Brown { c, x0, y0, k3, p2, .. } = project.cameras[0].interior else { panic!("a brown model") };
    assert_eq!((c, x0, k3, p2), (Some(12.5), 0.5, 3.0, 5.0));
    assert!((y0 - 0.1).abs() < 1e-12);
    assert!(project.cameras[0].free.is_empty());
    assert_eq!(project.photos[0].file, "a.jpg");
    let roles: Vec<_> = project.points.iter().map(|point| (point.id.as_str(), point.role)).collect();
    assert_eq!(roles, [("1", Role::Control), ("3", Role::Check), ("8", Role::Tie), ("9", Role::Tie)]);
    assert_eq!(project.points[0].sigma, Some([Some(0.1), Some(0.2), Some(0.3)]));
    assert_eq!(project.observations[0].sigma, Sigma::One(0.5));
    // One ray is enough for control, not for a tie point.
    assert_eq!(project.observations.iter().map(|o| o.enabled).collect::<Vec<_>>(), [true, true, true, false]);
    let free = import(&files(&SCRIPT.replace("<io>false</io>", "<io><all>true</all></io>"))).unwrap();
    assert_eq!(free.cameras[0].free.len(), 8);
}

#[test]
fn what_is_wrong_is_named() {
    let error = |from: &str, to: &str| import(&files(&SCRIPT.replace(from, to))).unwrap_err();
    assert_eq!(error("</input>", "").code(), "invalid");
    assert_eq!(error("ref/control.txt", "other.txt").code(), "unknown");
    for (name, wrong) in [
        ("aspect", "<aspect>one</aspect>"),
        ("aspect", "<aspect>1,0x</aspect>"),
        ("aspect", "<aspect></aspect>"),
        ("aspect", "<aspect>0</aspect>"),
        ("aspect", "<aspect>-1</aspect>"),
        ("aspect", "<aspect>inf</aspect>"),
        ("aspect", "<aspect>NaN</aspect>"),
    ] {
        let found = error("<aspect>1</aspect>", wrong);
        assert_eq!((found.code(), found.place().field.as_deref()), ("invalid", Some(name)), "{wrong}");
    }
    assert!(import(&files(&SCRIPT.replace("<aspect>1</aspect>", ""))).is_ok());
    assert_eq!(error("<pp>10.5,4.9</pp>", "").place().field.as_deref(), Some("pp"));
    assert_eq!(error("<cc>12.5", "<cc>-12.5").place().field.as_deref(), Some("cc"));
    let one_sided = SCRIPT.replace("id,im,x,y\" sxy=\"0.5\"", "id,im,x,y,sx\"");
    let mut given = files(&one_sided);
    given.insert("marks.txt".into(), b"1, 1, 10.5, 20.5, 0.5\n".to_vec());
    assert_eq!(import(&given).unwrap_err().place().field.as_deref(), Some("sy"));
    assert_eq!(error("<model>3", "<model>-1").place().field.as_deref(), Some("model"));
    assert_eq!(error("<cc>12.5", "<cc>long").place().field.as_deref(), Some("cc"));
    assert_eq!(error("id,im,x,y", "id,x,y").place().field.as_deref(), Some("format"));
    let mut damaged = files(SCRIPT);
    damaged.insert("marks.txt".into(), b"1, 1, 2, 3\n1, 2, x, 4\n".to_vec());
    assert_eq!(import(&damaged).unwrap_err().place(), Place::line(2).with_field("x").with_file("marks.txt"));
    assert!(import(&Files::from([("a.xml".into(), b"<a><b></a>".to_vec())])).is_err());
    assert!(import(&Files::from([("a.xml".into(), b"".to_vec())])).is_err());
    assert!(import(&Files::from([("a.xml".into(), "<a>".repeat(200_000).into_bytes())])).is_err());
}
