//! The project file: a zip archive (deflate) with `project.json`, `targets.json`, `adjustment.json` and the folder `photos/`.
//!
//! Reading trusts nothing: a foreign or damaged archive, names that point elsewhere and archives that unpack to more than
//! the limits are errors. A bare `project.json` is taken for a project file too.

use crate::reason::ExchangeReason;
use std::borrow::Cow;
use std::cell::Cell;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::io::{BufRead, BufReader, Cursor, Read, Seek, SeekFrom, Write};
use std::rc::Rc;

use serde::Serialize;
use serde::de::DeserializeOwned;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use self::around::{Around, Mode};
use sightline::adjustment::Adjustment;
use sightline::detection::Detection;
use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::limits;
use sightline::project::{Project, RemovedFields};

mod around;

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
    /// Damaged contents that are left out, each with its entry in the archive; not written to JSON.
    pub damaged: Vec<Error>,
}

/// A photo of a project file that was read without its photos.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// Its bytes are stored without compression: offset and length.
    At(u64, u64),
    /// They were packed.
    Unpacked(Vec<u8>),
}

/// Writes a project file. Photos are stored as they are: they are compressed already.
///
/// # Errors
/// [`Error::Invalid`] for a photo whose file name is a path.
pub fn write(package: &Package) -> Result<Vec<u8>> {
    let mut photos = package.photos.iter().map(|(name, bytes)| (name.as_str(), &bytes[..])).collect::<Vec<_>>();
    let pieces = write_around(package, &mut photos)?;
    let between = package.photos.values().map(Vec::as_slice).chain([&[][..]]);
    Ok(pieces.iter().zip(between).flat_map(|(piece, photo)| [piece.as_slice(), photo]).flatten().copied().collect())
}

/// Writes the parts before, between and after the photos of a project file: with the bytes of the photos in their order between the
/// pieces it is the file. Photos are read once, in pieces, and never held. Those of `package` itself are left out.
///
/// # Errors
/// [`Error::Invalid`] for a photo whose file name is a path, or that cannot be read; it is named.
pub fn write_around(package: &Package, photos: &mut [(&str, impl Read)]) -> Result<Vec<Vec<u8>>> {
    let mode = Rc::new(Cell::new(Mode::Keep));
    let mut archive = ZipWriter::new(Around::new(mode.clone()));
    let mut add = |name: &str, bytes: &[u8]| {
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        archive.start_file(name, options).map_err(cannot_write)?;
        archive.write_all(bytes).map_err(|error| cannot_write(error.into()))
    };
    add("project.json", &json(&package.project)?)?;
    if !package.targets.is_empty() {
        add("targets.json", &json(&package.targets)?)?;
    }
    if let Some(adjustment) = &package.adjustment {
        add("adjustment.json", &json(adjustment)?)?;
    }
    for (name, bytes) in photos {
        if !plain(name) {
            return Err(Error::Invalid {
                reason: ExchangeReason::NameWithFolders.into(),
                at: Place::default().with_file(*name),
            });
        }
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        let started = archive.start_file(format!("photos/{name}"), options);
        started.map_err(|error| cannot_write(error).in_file(name))?;
        mode.set(Mode::Pass);
        let copied = std::io::copy(&mut BufReader::with_capacity(PIECE, bytes), &mut archive);
        copied.map_err(|error| cannot_write(error.into()).in_file(name))?;
        mode.set(Mode::Cut);
    }
    Ok(archive.finish().map_err(cannot_write)?.into_pieces())
}

/// Files in an archive, compressed: tables that belong together and are handed over as one.
///
/// # Errors
/// [`Error::Invalid`] if a name is none of an archive.
pub fn archive(files: &super::Files) -> Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        archive.start_file(name.as_str(), options).map_err(cannot_write)?;
        archive.write_all(bytes).map_err(|error| cannot_write(error.into()))?;
    }
    archive.finish().map(Cursor::into_inner).map_err(cannot_write)
}

/// Reads a project file, photos and all, as [`read_from`] does.
///
/// # Errors
/// Those of [`read_from`].
pub fn read(bytes: &[u8]) -> Result<Package> {
    let (package, photos) = read_from(Cursor::new(bytes))?;
    let content = |held| match held {
        // It was read there.
        Held::At(start, size) => bytes[start as usize..][..size as usize].to_vec(),
        Held::Unpacked(content) => content,
    };
    Ok(Package { photos: photos.into_iter().map(|(name, held)| (name, content(held))).collect(), ..package })
}

/// Reads a project file without holding its photos: their bytes go by once, for their checksums. The checksum of every entry is checked:
/// a damaged result costs the result, damaged targets the targets, a damaged photo the photo, and each is named in `damaged`;
/// a damaged document is an error.
///
/// # Errors
/// [`Error::Invalid`] if it is not a project file, is damaged or too large by its headers, before memory is taken for it.
pub fn read_from(mut source: impl Read + Seek) -> Result<(Package, BTreeMap<String, Held>)> {
    let unreadable = |error: std::io::Error| damaged(&error.into());
    let length = source.seek(SeekFrom::End(0)).map_err(unreadable)?;
    let mut source = BufReader::with_capacity(PIECE, source);
    source.rewind().map_err(unreadable)?;
    if is_json(source.fill_buf().map_err(unreadable)?) {
        let content = unpack(&mut source, length, limits::DOCUMENT)?;
        return Ok((Package { project: super::document(&content)?, ..Package::default() }, BTreeMap::new()));
    }
    let counted = entries(&mut source, length).map_err(unreadable)?;
    let mut archive = ZipArchive::new(source).map_err(|error| damaged(&error))?;
    // Of several entries of one name the directory in memory has the last.
    if counted.is_some_and(|counted| counted > archive.len()) {
        return Err(invalid(ExchangeReason::SameNames.into()));
    }
    if archive.len() > limits::ENTRIES {
        return Err(invalid(ExchangeReason::Entries { entries: archive.len(), limit: limits::ENTRIES }.into()));
    }
    let running_over = running_over(&mut archive)?;
    let (mut package, mut photos) = (Package::default(), BTreeMap::new());
    let (mut found, mut room) = (false, photos_room(length));
    for index in 0..archive.len() {
        let Some(Ok(name)) = archive.name_for_index(index).map(|name| name.map(Cow::into_owned)) else {
            package.damaged.push(invalid(ExchangeReason::EntryName.into()));
            continue;
        };
        let damage = |error: ZipError| ExchangeReason::DamagedEntry { message: shortened(&error.to_string()) }.into();
        let opened = if running_over.contains(&index) {
            Err(ExchangeReason::EntrySize.into())
        } else {
            archive.by_index(index).map_err(damage)
        };
        let mut entry = match opened {
            Ok(entry) => entry,
            // The data at its place differ from the directory; that affects only this entry.
            Err(reason) if known(&name) => {
                let error = invalid(reason).in_file(&name);
                if name == DOCUMENT {
                    return Err(error);
                }
                package.damaged.push(error);
                continue;
            }
            Err(_) => continue,
        };
        let claimed = entry.size();
        if name == DOCUMENT {
            let content = unpack(&mut entry, claimed, limits::DOCUMENT).map_err(|error| error.in_file(&name))?;
            package.project = super::document(&content).map_err(|error| error.in_file(&name))?;
            found = true;
        } else if name == "targets.json" {
            let targets = unpack(&mut entry, claimed, limits::DOCUMENT).and_then(|content| parse(&content));
            package.keep(&name, targets, |package, targets| package.targets = targets);
        } else if name == "adjustment.json" {
            let adjustment = unpack(&mut entry, claimed, limits::DOCUMENT).and_then(|content| adjustment(&content));
            package.keep(&name, adjustment, |package, adjustment| package.adjustment = adjustment);
        } else if let Some(file) = name.strip_prefix(PHOTOS).filter(|file| plain(file)) {
            let held = match entry.data_start() {
                Some(start) if entry.compression() == CompressionMethod::Stored && !entry.encrypted() => {
                    passed(&mut entry, claimed).map(|()| Held::At(start, claimed))
                }
                _ => {
                    if claimed > room {
                        return Err(too_large(room).in_file(&name));
                    }
                    room -= claimed;
                    unpack(&mut entry, claimed, claimed).map(Held::Unpacked)
                }
            };
            package.keep(&name, held, |_, held| _ = photos.insert(file.to_owned(), held));
        }
    }
    package.number_targets();
    if found { Ok((package, photos)) } else { Err(invalid(ExchangeReason::NoProjectInside.into())) }
}

/// The entry of the document, and the folder of the photos.
const DOCUMENT: &str = "project.json";
const PHOTOS: &str = "photos/";

/// Bytes that are read at a time.
const PIECE: usize = 1 << 20;

/// Whether a file begins as JSON does, in any encoding that texts have: behind its mark, and between the zeros of UTF-16.
fn is_json(start: &[u8]) -> bool {
    let mark = |byte: &u8| matches!(byte, 0 | 0xef | 0xbb | 0xbf | 0xff | 0xfe) || byte.is_ascii_whitespace();
    start.iter().find(|byte| !mark(byte)) == Some(&b'{')
}

/// Number of entries stated at the end of an archive; `None` if it is not stated there (from 65,535 on), or not found.
fn entries(source: &mut (impl Read + Seek), length: u64) -> std::io::Result<Option<usize>> {
    /// Of the record at the end, without its comment, which has up to 65,535 bytes.
    const RECORD: usize = 22;
    let tail = length.min(RECORD as u64 + 0xffff);
    source.seek(SeekFrom::Start(length - tail))?;
    let mut bytes = vec![0; tail as usize];
    source.read_exact(&mut bytes)?;
    source.rewind()?;
    let record = bytes.windows(RECORD).rev().find(|window| window.starts_with(b"PK\x05\x06"));
    let count = record.map(|record| usize::from(u16::from_le_bytes([record[10], record[11]])));
    Ok(count.filter(|count| *count < 0xffff))
}

/// Whether an entry is part of a project.
fn known(name: &str) -> bool {
    [DOCUMENT, "targets.json", "adjustment.json"].contains(&name) || name.strip_prefix(PHOTOS).is_some_and(plain)
}

/// The entries that run into the header of another one: their own is damaged, or made to claim what is not theirs. Entries that are
/// not where the directory has them are not read, so they share nothing.
///
/// # Errors
/// Several entries that are one and the same: so a small file claims to be a large one.
fn running_over<R: Read + Seek>(archive: &mut ZipArchive<R>) -> Result<HashSet<usize>> {
    let mut ranges = Vec::new();
    for index in 0..archive.len() {
        let Ok(entry) = archive.by_index_raw(index) else { continue };
        let end = entry.data_start().map(|start| start.saturating_add(entry.compressed_size()));
        ranges.extend(end.map(|end| (entry.header_start(), end, index)));
    }
    ranges.sort_unstable();
    if ranges.windows(2).any(|pair| pair[0].0 == pair[1].0) {
        return Err(invalid(ExchangeReason::SharedBytes.into()));
    }
    Ok(ranges.windows(2).filter(|pair| pair[0].1 > pair[1].0).map(|pair| pair[0].2).collect())
}

/// Reads an entry that claims a size to its end and checks it, without holding it.
fn passed(entry: &mut impl Read, claimed: u64) -> Result<()> {
    let damaged =
        |error: std::io::Error| ExchangeReason::DamagedEntry { message: shortened(&error.to_string()) }.into();
    let mut buffer = vec![0; PIECE];
    let mut left = claimed;
    loop {
        match entry.read(&mut buffer).map_err(|error| invalid(damaged(error)))? {
            0 if left == 0 => return Ok(()),
            read if read > 0 && read as u64 <= left => left -= read as u64,
            _ => return Err(invalid(ExchangeReason::EntrySize.into())),
        }
    }
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

/// Maximum number of bytes of photos in a file of a size.
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
        reason: ExchangeReason::DamagedEntry { message: shortened(&error.to_string()) }.into(),
        at: Place { line: Some(error.line()), ..Place::default() },
    })
}

/// Reads an adjustment. `None` if it was computed with fields that were removed from the format; `origin.ignored` of the project lists them.
fn adjustment(bytes: &[u8]) -> Result<Option<Adjustment>> {
    let read = parse(bytes)?;
    let removed = std::str::from_utf8(bytes).is_ok_and(RemovedFields::in_adjustment);
    Ok((!removed).then_some(read))
}

/// Unpacks an entry that claims a size; it is held to it.
fn unpack(entry: &mut impl Read, claimed: u64, limit: u64) -> Result<Vec<u8>> {
    if claimed > limit {
        return Err(too_large(limit));
    }
    let mut content = Vec::new();
    let read = entry.take(claimed + 1).read_to_end(&mut content);
    read.map_err(|error| invalid(ExchangeReason::DamagedEntry { message: shortened(&error.to_string()) }.into()))?;
    if content.len() as u64 != claimed {
        return Err(invalid(ExchangeReason::EntrySize.into()));
    }
    Ok(content)
}

fn too_large(limit: u64) -> Error {
    invalid(ExchangeReason::Unpacks { megabytes: limit >> 20 }.into())
}

/// Whether a name is a file's and no path.
fn plain(name: &str) -> bool {
    !name.is_empty() && !name.contains(['/', '\\', ':', '\0']) && name != "." && name != ".."
}

fn damaged(error: &ZipError) -> Error {
    invalid(ExchangeReason::DamagedArchive { message: shortened(&error.to_string()) }.into())
}

fn cannot_write(error: ZipError) -> Error {
    invalid(ExchangeReason::CannotPack { message: error.to_string() }.into())
}

fn invalid(reason: Reason) -> Error {
    Error::Invalid { reason, at: Place::default() }
}

#[cfg(test)]
mod tests;
