//! The project file: a zip archive (deflate) with `project.json`, `targets.json`, `adjustment.json` and the folder `photos/`.
//!
//! Reading trusts nothing: a foreign or damaged archive, names that point elsewhere and archives that unpack to more than
//! the limits are errors. A bare `project.json` is taken for a project file too.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::io::{Cursor, Read, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::adjustment::Adjustment;
use crate::detection::Detection;
use crate::error::{Error, Place, Reason, Result, shortened};
use crate::limits;
use crate::project::Project;

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
    /// What was damaged and is left out, each with the entry it stood in; not written.
    pub damaged: Vec<Error>,
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

/// Reads a project file. The checksum of every entry is checked: a damaged result costs the result, damaged targets the targets,
/// a damaged photo the photo, and each is named in `damaged`; a damaged document is an error.
///
/// # Errors
/// [`Error::Invalid`] for what is no project file, is damaged or too large by its headers, before memory is taken for it.
pub fn read(bytes: &[u8]) -> Result<Package> {
    if bytes.trim_ascii_start().first() == Some(&b'{') {
        return Ok(Package { project: super::document(bytes)?, ..Package::default() });
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
    if archive.len() > limits::ENTRIES {
        return Err(invalid(Reason::Entries { entries: archive.len(), limit: limits::ENTRIES }));
    }
    if archive.has_overlapping_files().map_err(|error| damaged(&error))? {
        return Err(invalid(Reason::SharedBytes));
    }
    let mut package = Package::default();
    let (mut found, mut room) = (false, photos_room(bytes.len() as u64));
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| damaged(&error))?;
        let name = entry.name().map_err(|error| damaged(&error))?.into_owned();
        let claimed = entry.size();
        if name == "project.json" {
            let content = unpack(&mut entry, claimed, limits::DOCUMENT).map_err(|error| error.in_file(&name))?;
            package.project = super::document(&content).map_err(|error| error.in_file(&name))?;
            found = true;
        } else if name == "targets.json" {
            let targets = unpack(&mut entry, claimed, limits::DOCUMENT).and_then(|content| parse(&content));
            package.keep(&name, targets, |package, targets| package.targets = targets);
        } else if name == "adjustment.json" {
            let adjustment = unpack(&mut entry, claimed, limits::DOCUMENT).and_then(|content| parse(&content));
            package.keep(&name, adjustment, |package, adjustment| package.adjustment = Some(adjustment));
        } else if let Some(file) = name.strip_prefix("photos/").filter(|file| plain(file)) {
            if claimed > room {
                return Err(too_large(room).in_file(&name));
            }
            let content = unpack(&mut entry, claimed, room);
            room -= claimed;
            package.keep(&name, content, |package, content| _ = package.photos.insert(file.to_owned(), content));
        }
    }
    package.number_targets();
    if found { Ok(package) } else { Err(invalid(Reason::NoProjectInside)) }
}

impl Package {
    /// Targets and observations of files in which they had no numbers yet: an observation belonged to the target at exactly
    /// its place.
    fn number_targets(&mut self) {
        self.targets.values_mut().for_each(Detection::number_targets);
        let mut at: HashMap<(&str, [u64; 2]), u32> = HashMap::new();
        for (photo, detection) in &self.targets {
            at.extend(detection.targets.iter().map(|t| ((photo.as_str(), [t.u.to_bits(), t.v.to_bits()]), t.id)));
        }
        let numbers: HashSet<(&str, u32)> =
            self.targets.iter().flat_map(|(photo, d)| d.targets.iter().map(|t| (photo.as_str(), t.id))).collect();
        for o in &mut self.project.observations {
            let known = |id: &u32| numbers.contains(&(o.photo.as_str(), *id));
            let here = || at.get(&(o.photo.as_str(), [o.u.to_bits(), o.v.to_bits()])).copied();
            o.target = o.target.filter(known).or_else(here);
        }
    }

    /// Takes over what was read of an entry, or that it was damaged.
    fn keep<T>(&mut self, name: &str, content: Result<T>, take: impl FnOnce(&mut Self, T)) {
        match content {
            Ok(content) => take(self, content),
            Err(error) => self.damaged.push(error.in_file(name)),
        }
    }
}

/// Most bytes of photos in a file of a size.
fn photos_room(file: u64) -> u64 {
    limits::PHOTOS.min(file.saturating_mul(limits::PHOTOS_RATIO).saturating_add(limits::PHOTOS_FREE))
}

/// A document as JSON. Numbers keep every bit.
pub fn json(value: &impl Serialize) -> Result<Vec<u8>> {
    serde_json::to_vec(value).map_err(|error| invalid(Reason::CannotWriteJson { message: error.to_string() }))
}

fn parse<T: DeserializeOwned>(bytes: &[u8]) -> Result<T> {
    super::check_parsed(bytes)?;
    serde_json::from_slice(bytes).map_err(|error| Error::Invalid {
        reason: Reason::DamagedEntry { message: shortened(&error.to_string()) },
        at: Place { line: Some(error.line()), ..Place::default() },
    })
}

/// Unpacks an entry that claims a size; it is held to it.
fn unpack(entry: &mut impl Read, claimed: u64, limit: u64) -> Result<Vec<u8>> {
    if claimed > limit {
        return Err(too_large(limit));
    }
    let mut content = Vec::new();
    let read = entry.take(claimed + 1).read_to_end(&mut content);
    read.map_err(|error| invalid(Reason::DamagedEntry { message: shortened(&error.to_string()) }))?;
    if content.len() as u64 != claimed {
        return Err(invalid(Reason::EntrySize));
    }
    Ok(content)
}

fn too_large(limit: u64) -> Error {
    invalid(Reason::Unpacks { megabytes: limit >> 20 })
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
    use crate::project::{Observation, Photo, Sigma};
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
        Package { project, targets, photos: [("사진 1.jpg".to_owned(), vec![1, 2, 3])].into(), ..Package::default() }
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
    fn targets_without_numbers_get_them_and_their_observations_too() {
        let mut old = package();
        let detection = old.targets.get_mut("1").unwrap();
        detection.targets = [3.25, 7.5, 9.0].map(|u| crate::matching::target(u, 1.0 / 3.0, None)).into();
        let at = |point: &str, u: f64, target| Observation {
            photo: "1".into(),
            point: point.into(),
            u,
            v: 1.0 / 3.0,
            sigma: Sigma::One(0.1),
            enabled: true,
            target,
        };
        old.project.observations = vec![at("a", 7.5, None), at("by hand", 7.500001, None), at("lost", 1.0, Some(9))];
        let new = read(&write(&old).unwrap()).unwrap();
        assert_eq!(new.targets["1"].targets.iter().map(|t| t.id).collect::<Vec<_>>(), [1, 2, 3]);
        let numbers: Vec<_> = new.project.observations.iter().map(|o| o.target).collect();
        assert_eq!(numbers, [Some(2), None, None]);
        assert_eq!(read(&write(&new).unwrap()).unwrap(), new);
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

    #[test]
    fn a_damaged_part_costs_that_part() {
        let all = Package { adjustment: Some(Adjustment::default()), ..package() };
        let bytes = write(&all).unwrap();
        assert_eq!(read(&bytes).unwrap(), all);
        for (name, cost) in [
            ("adjustment.json", Package { adjustment: None, ..all.clone() }),
            ("targets.json", Package { targets: BTreeMap::new(), ..all.clone() }),
            ("photos/사진 1.jpg", Package { photos: BTreeMap::new(), ..all.clone() }),
        ] {
            let mut bad = bytes.clone();
            let header = bytes.windows(name.len()).position(|w| w == name.as_bytes()).expect("the entry");
            bad[header + name.len() + 1] ^= 0x11;
            let read = read(&bad).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(read.damaged.len(), 1, "{name}");
            assert_eq!(read.damaged[0].place().file.as_deref(), Some(name));
            assert_eq!(Package { damaged: Vec::new(), ..read }, cost);
        }
        let document = json(&all.project).unwrap();
        let wrong = archive(&[("project.json", &document), ("adjustment.json", b"{\"termination\": 3}")]);
        assert_eq!(read(&wrong).unwrap().damaged[0].place().file.as_deref(), Some("adjustment.json"));
    }

    /// Sets the size that entries claim in both of their headers.
    fn claim(bytes: &mut [u8], name: &str, size: u32) {
        for (mark, size_at, name_at) in [(b"PK\x03\x04", 22, 30), (b"PK\x01\x02", 24, 46)] {
            for at in 0..bytes.len() - name_at {
                if bytes[at..].starts_with(mark) && bytes[at + name_at..].starts_with(name.as_bytes()) {
                    bytes[at + size_at..at + size_at + 4].copy_from_slice(&size.to_le_bytes());
                }
            }
        }
    }

    #[test]
    fn memory_is_bounded_by_what_the_headers_claim() {
        let document = json(&package().project).unwrap();
        let zeros = vec![0; 80 << 20];
        let bomb = archive(&[("project.json", &document), ("photos/a.jpg", &zeros)]);
        assert!(bomb.len() < 1 << 20);
        let error = read(&bomb).unwrap_err();
        assert!(error.to_string().contains("unpacks to more than"), "{error}");
        assert_eq!(error.place().file.as_deref(), Some("photos/a.jpg"));
        // it claims less than it is
        let mut liar = archive(&[("project.json", &document), ("photos/a.jpg", &zeros[..1 << 20])]);
        claim(&mut liar, "photos/a.jpg", 1000);
        let read_back = read(&liar).unwrap();
        assert!(read_back.photos.is_empty() && read_back.damaged.len() == 1);
        let mut large = archive(&[("project.json", &document)]);
        claim(&mut large, "project.json", 600 << 20);
        assert!(read(&large).unwrap_err().to_string().contains("512 MB"));
        let lists = format!("{{\"format\": \"sightline\", \"version\": 1, \"points\": [{}]}}", "[],".repeat(4 << 20));
        assert!(read(lists.as_bytes()).unwrap_err().to_string().contains("would take more than"));
    }

    #[test]
    fn entries_that_share_bytes_are_refused() {
        let document = json(&package().project).unwrap();
        let mut bytes =
            archive(&[("project.json", &document), ("photos/a.jpg", &document), ("photos/b.jpg", &document)]);
        // the last entry of the directory points to the one before
        let headers = |bytes: &[u8], mark: &[u8; 4]| {
            (0..bytes.len() - 4).filter(|at| bytes[*at..].starts_with(mark)).collect::<Vec<_>>()
        };
        let (local, central) = (headers(&bytes, b"PK\x03\x04"), headers(&bytes, b"PK\x01\x02"));
        bytes[central[2] + 42..central[2] + 46].copy_from_slice(&(local[1] as u32).to_le_bytes());
        assert!(read(&bytes).is_err());
    }
}
