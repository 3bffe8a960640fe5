//! The project file: a zip archive (deflate) with `project.json`, `targets.json`, `adjustment.json` and the folder `photos/`.
//!
//! Reading trusts nothing: a foreign or damaged archive, names that point elsewhere and archives that unpack to more than
//! the limits are errors. A bare `project.json` is taken for a project file too.

use std::collections::BTreeMap;
use std::io::{Cursor, Read, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::adjustment::Adjustment;
use crate::detection::Detection;
use crate::error::{Error, Place, Reason, Result, shortened};
use crate::project::Project;

/// Most bytes that a document may have when unpacked.
const DOCUMENT_LIMIT: u64 = 512 << 20;
/// Most bytes that all photos may have: wasm has 4 GB for everything.
const PHOTOS_LIMIT: u64 = 2 << 30;
/// Most entries of an archive.
const ENTRIES_LIMIT: usize = 20_000;

/// Content of a project file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Package {
    /// The document.
    pub project: Project,
    /// Detected targets by photo.
    pub targets: BTreeMap<String, Detection>,
    /// The last adjustment.
    pub adjustment: Option<Adjustment>,
    /// The photos' files by name.
    pub photos: BTreeMap<String, Vec<u8>>,
}

/// Writes a project file. Photos are stored as they are: they are compressed already.
///
/// # Errors
/// [`Error::Invalid`] for a photo whose file name is a path.
pub fn write(package: &Package) -> Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let mut add = |name: &str, bytes: &[u8], method| {
        let options = SimpleFileOptions::default().compression_method(method);
        archive.start_file(name, options).map_err(cannot_write)?;
        archive.write_all(bytes).map_err(|error| cannot_write(error.into()))
    };
    add("project.json", &json(&package.project)?, CompressionMethod::Deflated)?;
    if !package.targets.is_empty() {
        add("targets.json", &json(&package.targets)?, CompressionMethod::Deflated)?;
    }
    if let Some(adjustment) = &package.adjustment {
        add("adjustment.json", &json(adjustment)?, CompressionMethod::Deflated)?;
    }
    for (name, bytes) in &package.photos {
        if !plain(name) {
            return Err(Error::Invalid { reason: Reason::NameWithFolders, at: Place::default().with_file(name) });
        }
        add(&format!("photos/{name}"), bytes, CompressionMethod::Stored)?;
    }
    archive.finish().map(Cursor::into_inner).map_err(cannot_write)
}

/// Files in an archive, compressed: tables that belong together and are handed over as one.
///
/// # Errors
/// [`Error::Invalid`] where a name is none of an archive.
pub fn archive(files: &super::Files) -> Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        archive.start_file(name.as_str(), options).map_err(cannot_write)?;
        archive.write_all(bytes).map_err(|error| cannot_write(error.into()))?;
    }
    archive.finish().map(Cursor::into_inner).map_err(cannot_write)
}

/// Reads a project file.
///
/// # Errors
/// [`Error::Invalid`] for what is no project file, is damaged or too large.
pub fn read(bytes: &[u8]) -> Result<Package> {
    if bytes.trim_ascii_start().first() == Some(&b'{') {
        return Ok(Package { project: super::document(bytes)?, ..Package::default() });
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
    if archive.len() > ENTRIES_LIMIT {
        return Err(invalid(Reason::Entries { entries: archive.len(), limit: ENTRIES_LIMIT }));
    }
    let mut package = Package::default();
    let (mut found, mut room) = (false, PHOTOS_LIMIT);
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| damaged(&error))?;
        let name = entry.name().map_err(|error| damaged(&error))?.into_owned();
        match name.as_str() {
            "project.json" => {
                package.project =
                    super::document(&unpack(&mut entry, DOCUMENT_LIMIT)?).map_err(|error| error.in_file(&name))?;
                found = true;
            }
            "targets.json" => package.targets = parse(&unpack(&mut entry, DOCUMENT_LIMIT)?, &name)?,
            "adjustment.json" => package.adjustment = Some(parse(&unpack(&mut entry, DOCUMENT_LIMIT)?, &name)?),
            _ => {
                let Some(file) = name.strip_prefix("photos/").filter(|file| plain(file)) else { continue };
                let content = unpack(&mut entry, room)?;
                room -= content.len() as u64;
                package.photos.insert(file.to_owned(), content);
            }
        }
    }
    if found { Ok(package) } else { Err(invalid(Reason::NoProjectInside)) }
}

/// A document as JSON. Numbers keep every bit.
pub fn json(value: &impl Serialize) -> Result<Vec<u8>> {
    // By way of a value, which has each name once: a flattened camera and its adjusted sigma share one.
    let failed = |error: serde_json::Error| invalid(Reason::CannotWriteJson { message: error.to_string() });
    let value = serde_json::to_value(value).map_err(failed)?;
    serde_json::to_vec(&value).map_err(failed)
}

fn parse<T: DeserializeOwned>(bytes: &[u8], name: &str) -> Result<T> {
    serde_json::from_slice(bytes).map_err(|error| {
        let at = Place { line: Some(error.line()), ..Place::default() }.with_file(name);
        Error::Invalid { reason: Reason::DamagedEntry { message: shortened(&error.to_string()) }, at }
    })
}

/// Unpacks an entry without believing its header.
fn unpack(entry: &mut impl Read, limit: u64) -> Result<Vec<u8>> {
    let mut content = Vec::new();
    entry.take(limit + 1).read_to_end(&mut content).map_err(|error| damaged(&error.into()))?;
    if content.len() as u64 > limit {
        return Err(invalid(Reason::Unpacks { megabytes: limit >> 20 }));
    }
    Ok(content)
}

/// Whether a name is a file's and no path.
fn plain(name: &str) -> bool {
    !name.is_empty() && !name.contains(['/', '\\', ':', '\0']) && name != "." && name != ".."
}

fn damaged(error: &ZipError) -> Error {
    invalid(Reason::DamagedArchive { message: shortened(&error.to_string()) })
}

fn cannot_write(error: ZipError) -> Error {
    invalid(Reason::CannotPack { message: error.to_string() })
}

fn invalid(reason: Reason) -> Error {
    Error::Invalid { reason, at: Place::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Photo;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn package() -> Package {
        let project = Project {
            name: "Zweibrücken".into(),
            photos: vec![Photo {
                id: "1".into(),
                camera: "c".into(),
                position: Some([0.1, 1.0 / 3.0, 1e-300]),
                enabled: true,
                ..Photo::default()
            }],
            ..Project::default()
        };
        let targets =
            BTreeMap::from([("1".to_owned(), Detection { width: 3, height: 2, bits: 8, ..Detection::default() })]);
        Package { project, targets, adjustment: None, photos: [("사진 1.jpg".to_owned(), vec![1, 2, 3])].into() }
    }

    fn archive(entries: &[(&str, &[u8])]) -> Vec<u8> {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, bytes) in entries {
            archive.start_file(*name, SimpleFileOptions::default()).unwrap();
            archive.write_all(bytes).unwrap();
        }
        archive.finish().unwrap().into_inner()
    }

    #[test]
    fn what_is_written_is_read_again_bit_for_bit() {
        let bytes = write(&package()).unwrap();
        assert_eq!(read(&bytes).unwrap(), package());
        assert_eq!(write(&read(&bytes).unwrap()).unwrap(), bytes);
        assert_eq!(read(&json(&package().project).unwrap()).unwrap().project, package().project);
    }

    #[test]
    fn damage_anywhere_is_an_error_or_harmless() {
        let bytes = write(&package()).unwrap();
        for cut in 0..bytes.len() {
            assert!(read(&bytes[..cut]).is_err(), "cut at {cut}");
        }
        for place in 0..bytes.len() {
            let mut bad = bytes.clone();
            bad[place] ^= 0x5a;
            // A changed time stamp is not noticed, a changed document is.
            if let Ok(read) = read(&bad) {
                assert_eq!(read.project, package().project, "byte {place}");
            }
        }
    }

    #[test]
    fn foreign_archives_and_bombs_are_refused() {
        assert!(read(b"").is_err());
        assert!(read(b"GIF89a").is_err());
        let detail = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(detail(&archive(&[("word/document.xml", b"<x/>")])).contains("no project.json"));
        assert!(
            detail(&archive(&[("project.json", b"{\"format\": \"other\"}")])).contains("not a document of Sightline")
        );
        assert!(
            detail(&archive(&[("project.json", b"{\"format\": \"sightline\", \"version\": 2}")])).contains("version 2")
        );
        for version in ["\"2\"", "1.5", "-1"] {
            let newer = format!("{{\"format\": \"sightline\", \"version\": {version}}}");
            let told = detail(&archive(&[("project.json", newer.as_bytes())]));
            assert!(told.contains(&format!("version {}", version.trim_matches('"'))), "{told}");
        }
        assert!(unpack(&mut std::io::repeat(0), 1000).unwrap_err().to_string().contains("unpacks"));
        let document = json(&package().project).unwrap();
        let odd = archive(&[
            ("project.json", &document),
            ("photos/../../etc/passwd", b"x"),
            ("photos/a/b.jpg", b"x"),
            ("/photos/c.jpg", b"x"),
        ]);
        assert!(read(&odd).unwrap().photos.is_empty());
        let path = Package { photos: [("../a.jpg".to_owned(), vec![])].into(), ..package() };
        assert!(write(&path).is_err());
    }
}
