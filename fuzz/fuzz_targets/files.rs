//! Any bytes as a file that is read: project files, every foreign format, EXIF. Each must end in a result or an error, and what was
//! read as a project can be written again in every format or is refused; what is written is read again.
//!
//! The first byte chooses the format: "0" to "=" in ASCII as they stand below, ">" to "E" for cameras by themselves. `seeds/files` has a small text of each; archives and EXIF blocks,
//! which are no texts, are made here and then damaged. Further files of a job follow after a line "%%%".
#![no_main]

use std::collections::BTreeMap;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use sightline::detect::detect;
use sightline::detection::DetectOptions;
use sightline_exchange::package::Package;
use sightline_exchange::foreign::CameraOptions;
use sightline_exchange::{Choices, Files, Imported, cameras, comparator, encoding, export, import, import_files, package};
use sightline::exif;
use sightline::image::{GreyView, SamplesView};
use sightline::project::{Camera, Interior, Observation, Photo, Point, Project, Sigma};

/// Formats that are read, and names of a file that they look for.
const READ: [(&str, &str); 14] = [
    ("sightline", "a.json"),
    ("package", "a.sightline"),
    ("control-csv", "a.csv"),
    ("mark-points", "markpts.txt"),
    ("photomodeler", "a.txt"),
    ("aicon", "a.obc"),
    ("dbat", "a.xml"),
    ("comparator", "a.csv"),
    ("colmap", "cameras.txt"),
    ("metashape", "a.xml"),
    ("bal", "a.txt"),
    ("bundler", "a.out"),
    ("meshroom", "a.sfm"),
    ("vstars", "a.csv"),
];
/// Formats of cameras, after those in the order of the first byte.
const CAMERAS: [(&str, &str); 8] = [
    ("opencv", "a.yml"),
    ("ros", "a.yaml"),
    ("kalibr", "a.yaml"),
    ("mrcal", "a.cameramodel"),
    ("colmap", "cameras.bin"),
    ("agisoft-lens", "a.xml"),
    ("micmac", "a.xml"),
    ("auto", "a"),
];
/// More formats that are read, after those of cameras: seeds keep their first byte.
const LATER: [(&str, &str); 4] = [("nvm", "a.nvm"), ("opensfm", "a.json"), ("pix4d", "a.txt"), ("realitycapture", "a.xmp")];
const WRITTEN: [&str; 21] = [
    "sightline", "package", "control-csv", "mark-points", "csv", "tsv", "dxf", "ply", "gltf", "colmap", "colmap-binary", "metashape", "bal", "bundler",
    "meshroom", "vstars", "spreadsheet", "spreadsheet-cp949", "calibration", "dxf-2010", "landxml",
];
/// Names of the files after the first: jobs of DBAT and COLMAP ask for them.
const MORE: [&str; 4] = ["control.txt", "images.txt", "marks.txt", "points3D.txt"];
const BETWEEN: &[u8] = b"\n%%%\n";

/// A JPEG that ends after an EXIF block of this maker.
const PHOTO: &[u8] =
    b"\xff\xd8\xff\xe1\0\x28Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x0f\0\x02\0\0\0\x06\0\0\0\x1a\0\0\0\0Maker\0\xff\xd9";

/// A project file with something in every entry.
fn archive() -> Vec<u8> {
    let photo = Photo { id: "p".into(), camera: "c".into(), file: "a.jpg".into(), ..Photo::default() };
    let seen = Observation {
        photo: "p".into(),
        point: "1".into(),
        u: 1.0,
        v: 2.0,
        sigma: Sigma::One(0.1),
        enabled: true,
        target: None,
    };
    let project = Project {
        cameras: vec![Camera::new("c", 20, 10, Interior::brown(9.0))],
        photos: vec![photo].into(),
        points: vec![Point { id: "1".into(), ..Point::default() }].into(),
        observations: vec![seen].into(),
        ..Project::default()
    };
    let grey = (0..40 * 40).map(|k| if (k % 40 - 20) * (k % 40 - 20) + (k / 40 - 20) * (k / 40 - 20) < 60 { 220 } else { 30 });
    let samples: Vec<u8> = grey.collect();
    let view = GreyView::new(40, 40, SamplesView::U8(&samples)).expect("a picture");
    let detection = detect(&view, &DetectOptions::default()).expect("a target");
    let package = Package {
        project,
        targets: BTreeMap::from([("p".to_owned(), detection)]),
        photos: BTreeMap::from([("a.jpg".to_owned(), PHOTO.to_vec())]),
        ..Package::default()
    };
    package::write(&package).expect("a project file")
}

thread_local! {
    static ARCHIVE: Vec<u8> = archive();
}

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let begun = match seed % 32 {
        0 => [&b"1"[..], &ARCHIVE.with(Clone::clone)].concat(),
        1 => [&b"1"[..], PHOTO].concat(),
        _ => Vec::new(),
    };
    let fits = !begun.is_empty() && begun.len() <= max_size.min(data.len());
    if fits {
        data[..begun.len()].copy_from_slice(&begun);
    }
    fuzzer_mutate(data, if fits { begun.len() } else { size }, max_size)
});

/// A job's files, cut where a line parts them.
fn job(name: &str, mut rest: &[u8]) -> Files {
    let mut files = Files::new();
    for name in std::iter::once(name).chain(MORE) {
        let end = rest.windows(BETWEEN.len()).position(|window| window == BETWEEN);
        files.insert(name.to_owned(), rest[..end.unwrap_or(rest.len())].to_vec());
        let Some(end) = end else { break };
        rest = &rest[end + BETWEEN.len()..];
    }
    files
}

/// A camera that is read is written in every format or refused, and read again.
fn camera(format: &str, files: &Files) {
    let Ok(read) = cameras::import(format, files, &CameraOptions { convert: true, ..CameraOptions::default() }) else { return };
    for found in read.cameras.iter().take(3) {
        for (format, _) in CAMERAS.iter().filter(|(format, _)| *format != "auto") {
            let Ok(written) = cameras::export(format, &found.camera, &CameraOptions::default()) else { continue };
            let again = cameras::import(format, &written.files, &CameraOptions::default());
            assert!(again.is_ok(), "{format} is not read again: {again:?}");
        }
    }
}

fuzz_target!(|data: &[u8]| {
    let Some((choice, rest)) = data.split_first() else { return };
    let choice = usize::from(choice.wrapping_sub(b'0')) % (READ.len() + CAMERAS.len() + LATER.len());
    let later = choice.checked_sub(READ.len() + CAMERAS.len()).map(|choice| LATER[choice]);
    if let Some((format, name)) = choice.checked_sub(READ.len()).and_then(|choice| CAMERAS.get(choice)).copied() {
        camera(format, &Files::from([(name.to_owned(), rest.to_vec())]));
        return;
    }
    let (format, name) = later.unwrap_or_else(|| READ[choice]);
    let files = if format == "package" { Files::from([(name.to_owned(), rest.to_vec())]) } else { job(name, rest) };
    // A format without image sizes needs that of a photo.
    let choices = Choices { sizes: BTreeMap::from([("a.jpg".to_owned(), [40, 30])]), ..Choices::default() };
    if let Ok(Imported { project, .. }) = import_files(format, &files, &choices) {
        for format in WRITTEN {
            let Ok(mut written) = export(format, &project, None) else { continue };
            written.remove("interchange.json");
            if matches!(format, "sightline" | "package" | "colmap" | "colmap-binary" | "bundler" | "meshroom") {
                let again = import(format.trim_end_matches("-binary"), &written);
                assert!(again.is_ok(), "{format} is not read again: {again:?}");
            }
        }
    }
    let _ = package::read(rest);
    let _ = exif::read(rest);
    let _ = encoding::text(rest);
    let _ = comparator::recognises(&files);
});
