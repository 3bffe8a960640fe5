//! Files of the photos, and what is computed from them for the screen.

use std::collections::BTreeMap;

use leptos::prelude::*;
use sightline::exif::PhotoInfo;

use super::lateral_colour::ColourMeasurement;
use super::parts::PhotoPart;
use super::pictures::PhotoPicture;
use super::values::PixelRequest;
use crate::browser::file::Blob;
use crate::browser::picture::Picture;

/// File of a photo.
#[derive(Clone)]
pub struct PhotoFile {
    pub name: String,
    pub content: Blob,
    /// The user's own file, if `content` is the copy in the browser's storage.
    pub original: Option<Blob>,
    /// Width and height in pixels.
    pub size: [u32; 2],
    pub info: PhotoInfo,
    pub small: Picture,
    pub digest: u64,
    /// SHA-256; empty if it has not been computed since the file was opened.
    pub sha256: String,
}

/// Signals of the photos' files and pictures.
#[derive(Clone, Copy, Default)]
pub struct Photos {
    /// Files by the identifiers of their photos.
    pub files: RwSignal<BTreeMap<String, PhotoFile>, LocalStorage>,
    /// The second files of shots whose other file is measured: RAW beside the photo developed from it.
    pub others: StoredValue<Vec<PhotoFile>>,
    /// Decoded pictures, the last few.
    pub(super) pictures: RwSignal<Vec<PhotoPicture>, LocalStorage>,
    /// Number of views that show photos.
    pub(super) showing: StoredValue<usize>,
    /// Parts of photos in full resolution, the last few.
    pub(super) parts: RwSignal<Vec<PhotoPart>, LocalStorage>,
    /// Pixel values that the photo view asked for last.
    pub(super) values: RwSignal<PixelRequest>,
    /// Measurements of the lateral colour of photos, the last ones.
    pub(super) colours: RwSignal<Vec<ColourMeasurement>>,
}
