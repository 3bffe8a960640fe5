//! Projects of Metashape as one file (`.psz`), and the archives of the folder beside a `.psx`: zip archives whose `doc.xml` is the document, a
//! chunk or a frame. An element with a `path` is in an archive or a document with that path.

use crate::reason::ExchangeReason;
use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::super::dbat::element::{self, Element};
use super::super::encoding;
use sightline::error::{Error, Place, Result, shortened};
use sightline::limits;

const DOCUMENT: &str = "doc.xml";
/// Archives in archives: project, chunk, frame.
const DEPTH: usize = 3;

/// Whether bytes are such an archive.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
        && ZipArchive::new(Cursor::new(bytes)).is_ok_and(|archive| archive.index_for_name(DOCUMENT).is_some())
}

fn damaged(message: &str) -> Error {
    Error::Invalid { reason: ExchangeReason::DamagedEntry { message: shortened(message) }.into(), at: Place::default() }
}

/// The tree of an archive, with the contents of nested archives in their places.
///
/// # Errors
/// For an archive or an entry that is damaged or too large, and what its XML has wrong; the entry is named.
pub fn document(bytes: &[u8]) -> Result<Element> {
    let mut room = limits::DOCUMENT;
    opened(bytes, DEPTH, &mut room)
}

/// `room`: bytes that may yet be unpacked, of all archives together.
fn opened(bytes: &[u8], depth: usize, room: &mut u64) -> Result<Element> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
    if archive.len() > limits::ENTRIES {
        let reason = ExchangeReason::Entries { entries: archive.len(), limit: limits::ENTRIES }.into();
        return Err(Error::Invalid { reason, at: Place::default() });
    }
    let content = entry(&mut archive, DOCUMENT, room).and_then(|content| content.ok_or_else(|| damaged(DOCUMENT)))?;
    let mut root =
        encoding::text(&content).and_then(|text| element::parse(&text)).map_err(|error| error.in_file(DOCUMENT))?;
    drop(content);
    put_in(&mut root, &mut archive, depth, room)?;
    Ok(root)
}

/// Puts what a path names in place of the element that has it; what is not in this archive stays as it is.
fn put_in(element: &mut Element, archive: &mut ZipArchive<Cursor<&[u8]>>, depth: usize, room: &mut u64) -> Result<()> {
    for child in &mut element.children {
        if !matches!(child.name.as_str(), "chunks" | "chunk" | "frames" | "frame") {
            continue;
        }
        let path =
            child.attribute("path").map(str::to_owned).filter(|_| matches!(child.name.as_str(), "chunk" | "frame"));
        if let Some(path) = path.filter(|_| depth > 0) {
            let Some(content) = entry(archive, &path, room)? else { continue };
            let inner = if content.starts_with(b"PK\x03\x04") {
                opened(&content, depth - 1, room)
            } else {
                encoding::text(&content).and_then(|text| element::parse(&text))
            };
            let inner = inner.map_err(|error| error.in_file(&path))?;
            child.attributes.extend(inner.attributes);
            child.children = inner.children;
        } else {
            put_in(child, archive, depth, room)?;
        }
    }
    Ok(())
}

fn entry(archive: &mut ZipArchive<Cursor<&[u8]>>, name: &str, room: &mut u64) -> Result<Option<Vec<u8>>> {
    let Some(index) = archive.index_for_name(name) else { return Ok(None) };
    let named = |error: Error| error.in_file(name);
    let entry = archive.by_index(index).map_err(|error| named(damaged(&error.to_string())))?;
    let mut content = Vec::new();
    let limit = *room;
    entry.take(limit + 1).read_to_end(&mut content).map_err(|error| named(damaged(&error.to_string())))?;
    if content.len() as u64 > limit {
        let reason = ExchangeReason::Unpacks { megabytes: limits::DOCUMENT >> 20 }.into();
        return Err(named(Error::Invalid { reason, at: Place::default() }));
    }
    *room -= content.len() as u64;
    Ok(Some(content))
}

/// A document whose chunks stand directly in it, whatever the root is: a document, a chunk or a frame by itself.
pub fn levelled(root: Element) -> Element {
    let element =
        |name: &str, children: Vec<Element>| Element { name: name.to_owned(), children, ..Element::default() };
    match root.name.as_str() {
        "chunk" => element("document", vec![root]),
        "frame" => element("document", vec![element("chunk", vec![element("frames", vec![root])])]),
        _ => {
            let mut root = root;
            if let Some(place) = root.children.iter().position(|child| child.name == "chunks") {
                let chunks = root.children.remove(place);
                root.children.extend(chunks.children);
            }
            root
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Files;
    use std::io::Write;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    fn zipped(entries: &[(&str, &[u8])]) -> Vec<u8> {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, content) in entries {
            writer.start_file(*name, SimpleFileOptions::default()).unwrap();
            writer.write_all(content).unwrap();
        }
        writer.finish().unwrap().into_inner()
    }

    const HEAD: &str = "<sensors><sensor id=\"0\"><resolution width=\"4000\" height=\"3000\"/><calibration type=\"frame\" class=\"adjusted\"><resolution width=\"4000\" height=\"3000\"/><f>3200</f></calibration></sensor></sensors>\
        <cameras><camera id=\"5\" sensor_id=\"0\" label=\"a.jpg\"><transform>1 0 0 0 0 1 0 0 0 0 1 -4 0 0 0 1</transform></camera></cameras>\
        <markers><marker id=\"1\" label=\"P\"><reference x=\"0\" y=\"0\" z=\"0\" enabled=\"1\"/></marker><marker id=\"2\" label=\"Q\"/></markers>\
        <scalebars><scalebar id=\"0\" label=\"P_Q\"><endpoint marker_id=\"1\"/><endpoint marker_id=\"2\"/><reference d=\"0.5\" sd=\"0.0002\" enabled=\"true\"/></scalebar>\
        <scalebar id=\"1\"><endpoint marker_id=\"2\"/><endpoint marker_id=\"1\"/><reference d=\"0.25\" enabled=\"false\"/></scalebar>\
        <scalebar id=\"2\"><endpoint camera_id=\"5\"/><endpoint marker_id=\"1\"/></scalebar></scalebars>\
        <settings><property name=\"accuracy_scalebars\" value=\"0.001\"/></settings>";
    const FRAME: &str = "<markers><marker marker_id=\"1\"><location camera_id=\"5\" pinned=\"true\" x=\"2000\" y=\"1500\"/></marker></markers>";

    /// The same project in one document, as archives in an archive, and as the archives of the folder beside a .psx.
    #[test]
    fn projects_in_archives_are_those_of_one_document() {
        let chunk = format!("<chunk label=\"c\">{HEAD}<frames><frame id=\"0\">{FRAME}</frame></frames></chunk>");
        let whole = zipped(&[("doc.xml", format!("<document><chunks>{chunk}</chunks></document>").as_bytes())]);
        let frame = zipped(&[("doc.xml", format!("<frame>{FRAME}</frame>").as_bytes())]);
        let outer = format!("<chunk label=\"c\">{HEAD}<frames><frame id=\"0\" path=\"0/frame.zip\"/></frames></chunk>");
        let inner = zipped(&[("doc.xml", outer.as_bytes()), ("0/frame.zip", &frame)]);
        let nested = zipped(&[
            ("doc.xml", b"<document><chunks><chunk id=\"0\" path=\"0/chunk.zip\"/></chunks></document>"),
            ("0/chunk.zip", &inner),
        ]);
        let apart = zipped(&[("doc.xml", outer.as_bytes())]);
        let read = |files: &[(&str, &[u8])]| {
            let files: Files = files.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec())).collect();
            assert_eq!(crate::recognised(&files), Some("metashape"));
            crate::import_files("auto", &files, &crate::Choices::default()).unwrap()
        };
        let first = read(&[("p.psz", &whole)]);
        for other in [read(&[("p.psz", &nested)]), read(&[("chunk.zip", &apart), ("frame.zip", &frame)])] {
            let alike = |i: &crate::Imported| {
                (
                    i.project.cameras.clone(),
                    i.project.points.clone(),
                    i.project.observations.clone(),
                    i.project.distances.clone(),
                )
            };
            assert_eq!(alike(&first), alike(&other));
        }
        let project = &first.project;
        assert_eq!((project.observations.len(), project.observations[0].point.as_str()), (1, "P"));
        let bars: Vec<_> =
            project.distances.iter().map(|d| (d.from.as_str(), d.to.as_str(), d.length, d.sigma, d.check)).collect();
        assert_eq!(bars, [("P", "Q", 0.5, 0.0002, false), ("Q", "P", 0.25, 0.001, true)]);
        assert!(first.notes.ignored.iter().any(|ignored| ignored.name == "scale bars that end at a camera"));
    }

    #[test]
    fn damaged_archives_are_named() {
        let whole = zipped(&[("doc.xml", b"<document><chunks><chunk>")]);
        assert_eq!(document(&whole).unwrap_err().place().file.as_deref(), Some("doc.xml"));
        let mut cut = zipped(&[("doc.xml", b"<document><chunk><cameras/></chunk></document>")]);
        let middle = cut.len() / 2;
        cut[middle] ^= 0x55;
        cut.truncate(middle + 4);
        assert!(document(&cut).is_err());
        // An archive that names itself does not go on for ever.
        let own = zipped(&[("doc.xml", b"<document><chunks><chunk path=\"doc.xml\"/></chunks></document>")]);
        assert!(document(&own).is_ok());
    }
}
