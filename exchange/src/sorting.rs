//! Sorts files dropped together by content: networks and cameras of other programs, and the rest.
//!
//! A model of COLMAP, a project of DBAT and the exports of Metashape are several files; every other format is one file, RealityCapture's one per photo, Bundler's with a list
//! of pictures, OpenSfM's with a file of tracks. Binary files of COLMAP alone are recognised by their names, since their content has no signature. A file that is no picture,
//! no table and no project, and that cannot be read as what it begins like, is refused with the line.

use super::{
    Files, agisoft_lens, bal, cameras, colmap, comparator, dbat, encoding, lists, meshroom, metashape, opensfm,
    realitycapture, tree,
};
use crate::reason::ExchangeReason;
use sightline::error::{Error, Place};

/// Files of one format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Format, for `import_files` or `cameras::import`.
    pub format: &'static str,
    /// The files.
    pub files: Files,
}

/// Sorted files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sorted {
    /// Networks, each by itself.
    pub networks: Vec<Group>,
    /// Cameras without a network, file by file.
    pub cameras: Vec<Group>,
    /// Files that are neither: tables, lists, documents of this program, pictures.
    pub others: Files,
    /// Files that look like those of another program and cannot be read.
    pub refused: Vec<Error>,
}

/// Endings of other programs' files that nothing else has: what is not recognised there is refused, not tried as a picture.
const ENDINGS: [&str; 11] = ["xml", "xmp", "yml", "yaml", "sfm", "out", "bin", "cameramodel", "psz", "psx", "nvm"];

fn ending(name: &str) -> String {
    name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase()
}

/// Whether a file is a document of this program, by its beginning: it need not be read here.
fn is_own(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(sightline::equipment::HEAD)];
    bytes.starts_with(b"{") && head.windows(10).any(|word| word == b"\"sightline")
}

/// The format of one file with a network.
fn network_of(bytes: &[u8]) -> Option<&'static str> {
    if metashape::archive::recognises(bytes) {
        return Some("metashape");
    }
    let text = encoding::text(bytes).ok()?;
    let start = text.trim_start();
    if let Some(format) = super::by_its_head(&text) {
        return Some(format);
    }
    if start.starts_with('[') {
        let tree = tree::json(&text).ok()?;
        return opensfm::recognises(&tree::Node::root(&tree)).then_some("opensfm");
    }
    if realitycapture::recognises(&text) {
        return Some("realitycapture");
    }
    if start.starts_with('<') {
        let root = dbat::element::parse(&text).ok()?;
        if metashape::recognises(&root) {
            return Some("metashape");
        }
        return (root.name == "document" && root.child("input").is_some()).then_some("dbat");
    }
    if start.starts_with('{') {
        let tree = tree::json(&text).ok()?;
        return meshroom::recognises(&tree::Node::root(&tree)).then_some("meshroom");
    }
    if start.starts_with("Bundle Soln") {
        return Some("photomodeler");
    }
    bal::recognises(&text).then_some("bal")
}

/// Whether a text is a list of pictures, one a line.
fn lists_pictures(bytes: &[u8]) -> bool {
    let Ok(text) = encoding::text(bytes) else { return false };
    let picture = |line: &str| {
        let file = line.split_whitespace().next().unwrap_or_default();
        matches!(ending(file).as_str(), "jpg" | "jpeg" | "png" | "tif" | "tiff" | "bmp" | "ppm" | "pgm")
    };
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty()).peekable();
    lines.peek().is_some() && lines.all(picture)
}

/// Why a file of another program that is not recognised cannot be read; `None` for other files.
fn fault(name: &str, bytes: &[u8]) -> Option<Error> {
    let ending = ending(name);
    if !ENDINGS.contains(&ending.as_str()) || lists::is_of_an_instrument(bytes) {
        return None;
    }
    let unknown = Error::Invalid { reason: ExchangeReason::FormatUnrecognised.into(), at: Place::default() };
    let error = match encoding::text(bytes) {
        Err(error) if ending != "psz" && ending != "bin" => error,
        Err(_) => unknown,
        // What it begins like names the line where it stops being that.
        Ok(text) if text.trim_start().starts_with('<') => match dbat::element::parse(&text) {
            Err(error) => error,
            Ok(root) => {
                agisoft_lens::wrong(&root.name, "a document of Metashape, Agisoft Lens, MicMac, OpenCV or DBAT", "")
            }
        },
        Ok(text) if matches!(ending.as_str(), "yml" | "yaml" | "sfm") => tree::parse(&text).err().unwrap_or(unknown),
        Ok(_) => unknown,
    };
    Some(error.in_file(name))
}

/// Sorts files.
pub fn sorted(files: Files) -> Sorted {
    let mut all = Sorted::default();
    let mut rest = files;
    if colmap::recognises(&rest) {
        let (model, others): (Files, Files) = rest.into_iter().partition(|(name, _)| colmap::part(name).is_some());
        let network = model.keys().any(|name| colmap::part(name).is_some_and(|(part, _)| part == "images"));
        let group = Group { format: "colmap", files: model };
        if network { &mut all.networks } else { &mut all.cameras }.push(group);
        rest = others;
    }
    // Plates are described by a table of their own, in any of the files.
    if comparator::recognises(&rest) {
        all.others = rest;
        return all;
    }
    let (mut left, mut chunks, mut sidecars) = (Files::new(), Files::new(), Files::new());
    for (name, bytes) in rest {
        if is_own(&bytes) {
            all.others.insert(name, bytes);
            continue;
        }
        match network_of(&bytes) {
            Some("metashape") => drop(chunks.insert(name, bytes)),
            Some("realitycapture") => drop(sidecars.insert(name, bytes)),
            Some(format) => all.networks.push(Group { format, files: Files::from([(name, bytes)]) }),
            None => {
                let alone = Files::from([(name, bytes)]);
                let format = cameras::recognised(&alone);
                for (name, bytes) in alone {
                    match format {
                        Some(format) => all.cameras.push(Group { format, files: Files::from([(name, bytes)]) }),
                        None => drop(left.insert(name, bytes)),
                    }
                }
            }
        }
    }
    if !chunks.is_empty() {
        all.networks.push(Group { format: "metashape", files: chunks });
    }
    if !sidecars.is_empty() {
        all.networks.push(Group { format: "realitycapture", files: sidecars });
    }
    for group in &mut all.networks {
        let taken: Files = match group.format {
            // It names the tables that belong to it.
            "dbat" => std::mem::take(&mut left),
            "opensfm" => {
                let tracks = |bytes: &[u8]| encoding::text(bytes).is_ok_and(|text| opensfm::recognises_tracks(&text));
                let (tracks, others) = left.into_iter().partition(|(_, bytes)| tracks(bytes));
                left = others;
                tracks
            }
            "bundler" => {
                let (lists, others) = left.into_iter().partition(|(_, bytes)| lists_pictures(bytes));
                left = others;
                lists
            }
            _ => Files::new(),
        };
        group.files.extend(taken);
    }
    for (name, bytes) in left {
        match fault(&name, &bytes) {
            Some(error) => all.refused.push(error),
            None => drop(all.others.insert(name, bytes)),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn files(all: &[(&str, &str)]) -> Files {
        all.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())).collect()
    }

    fn formats(groups: &[Group]) -> Vec<(&str, Vec<&str>)> {
        groups.iter().map(|group| (group.format, group.files.keys().map(String::as_str).collect())).collect()
    }

    const CAMERAS: &str = "# Camera list\n1 PINHOLE 640 480 500 500 320 240\n";
    const OPENCV: &str = "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 500., 0., 319.5, 0., 500., 239.5, 0., 0., 1. ]\nimage_width: 640\nimage_height: 480\n";
    const MARKERS: &str = "<document><chunk><markers/></chunk></document>";

    #[test]
    fn a_drop_of_everything_is_sorted_by_content() {
        let sorted = sorted(files(&[
            ("sparse/cameras.txt", CAMERAS),
            ("sparse/images.txt", "# empty\n"),
            ("sparse/points3D.txt", ""),
            // The name of a table, the content of a camera.
            ("left.txt", OPENCV),
            ("a.xml", MARKERS),
            ("b.xml", MARKERS),
            ("result", "# Bundle file v0.3\n0 0\n"),
            ("pictures.txt", "a.jpg 0 500\nb.jpg\n"),
            ("control.csv", "id,X,Y,Z\nA,1,2,3\n"),
            ("photo.jpg", "\u{1}\u{2}"),
        ]));
        assert_eq!(formats(&sorted.cameras), [("opencv", vec!["left.txt"])]);
        let networks = formats(&sorted.networks);
        assert_eq!(networks.len(), 3, "{networks:?}");
        assert!(networks.contains(&("colmap", vec!["sparse/cameras.txt", "sparse/images.txt", "sparse/points3D.txt"])));
        assert!(networks.contains(&("metashape", vec!["a.xml", "b.xml"])));
        assert!(networks.contains(&("bundler", vec!["pictures.txt", "result"])));
        assert_eq!(sorted.others.keys().map(String::as_str).collect::<Vec<_>>(), ["control.csv", "photo.jpg"]);
        assert_eq!(sorted.refused, []);
    }

    #[test]
    fn cameras_alone_are_cameras_and_every_file_is_in_one_place() {
        let all = files(&[("cameras.txt", CAMERAS), ("x.yml", OPENCV), ("notes.txt", "Dear all\n"), ("p.json", "{}")]);
        let count = all.len();
        let sorted = sorted(all);
        assert_eq!(formats(&sorted.cameras), [("colmap", vec!["cameras.txt"]), ("opencv", vec!["x.yml"])]);
        let grouped: usize = sorted.networks.iter().chain(&sorted.cameras).map(|group| group.files.len()).sum();
        assert_eq!(grouped + sorted.others.len() + sorted.refused.len(), count);
    }

    #[test]
    fn damaged_files_name_file_and_line() {
        for (name, text) in [
            ("cut.xml", "<document>\n<chunk>\n<cameras"),
            ("cut.sfm", "{\n \"version\": [1, 2\n"),
            ("cut.yml", "%YAML:1.0\n---\na: [ 1, 2\nb: }\n"),
        ] {
            let sorted = sorted(files(&[(name, text)]));
            let [error] = &sorted.refused[..] else { panic!("{name}: {sorted:?}") };
            assert_eq!(error.place().file.as_deref(), Some(name));
            assert!(error.place().line.is_some(), "{name}: {error}");
        }
        // Well-formed, of no program that is read.
        for (name, text) in [("page.xml", "<html/>"), ("list.yml", "a: 1\n"), ("data.bin", "\u{0}\u{1}")] {
            let sorted = sorted(files(&[(name, text)]));
            assert_eq!(sorted.refused.len(), 1, "{name}");
        }
    }
}
