//! Photos with damaged rows: the intact parts are measured as separate pictures, so that targets cut by the damage are rejected
//! at the border.

use super::{check, detect, measure_at};
use crate::decode::DecodedPhoto;
use crate::detection::{DetectOptions, Detection, Target};
use crate::error::{Error, Place, Reason, Result};
use crate::image::{Grey, GreyView, Samples, SamplesView};

/// Finds and measures the targets of a photo, in its whole rows. How it was taken is what the largest part of them shows.
///
/// # Errors
/// As for [`detect`].
pub fn detect_photo(photo: &DecodedPhoto, options: &DetectOptions) -> Result<Detection> {
    if photo.damaged_rows.is_empty() {
        return Ok(Detection { page: photo.page, ..detect(&photo.grey.view()?, options)? });
    }
    check(options)?;
    let view = photo.grey.view()?;
    let size = |pixels| u32::try_from(pixels).unwrap_or(u32::MAX);
    let mut all = Detection {
        width: size(photo.grey.width),
        height: size(photo.grey.height),
        bits: view.bits(),
        damaged_rows: photo.damaged_rows.clone(),
        page: photo.page,
        ..Detection::default()
    };
    let mut largest = 0;
    for [first, last] in whole_rows(photo) {
        let mut part = detect(&rows(&photo.grey, first, last)?, options)?;
        let down = first as f64;
        part.targets = part.targets.into_iter().map(|target| target.moved([0.0, down])).collect();
        part.rejected_blobs.iter_mut().for_each(|blob| blob.v += down);
        if last - first > largest {
            largest = last - first;
            all.picture = part.picture;
        }
        all.targets.append(&mut part.targets);
        all.rejected_blobs.append(&mut part.rejected_blobs);
        for (reason, count) in part.rejected {
            *all.rejected.entry(reason).or_default() += count;
        }
    }
    all.targets.iter_mut().for_each(|target| target.id = 0);
    all.number_targets();
    Ok(all)
}

/// Measures the one target at a click, in whole rows; `None` if there is no target.
///
/// # Errors
/// [`Error::Invalid`] for a place in damaged rows, and as for [`measure_at`].
pub fn measure_in_photo(photo: &DecodedPhoto, u: f64, v: f64, options: &DetectOptions) -> Result<Option<Target>> {
    if photo.damaged_rows.is_empty() {
        return measure_at(&photo.grey.view()?, u, v, options);
    }
    let holds = |[first, last]: &[usize; 2]| v >= *first as f64 && v <= *last as f64;
    let Some([first, last]) = whole_rows(photo).into_iter().find(holds) else {
        return Err(Error::Invalid { reason: Reason::DamagedRow { value: v.into() }, at: Place::field("v") });
    };
    let target = measure_at(&rows(&photo.grey, first, last)?, u, v - first as f64, options)?;
    Ok(target.map(|target| target.moved([0.0, first as f64])))
}

/// Rows between the damaged ones: first row and the row after the last.
fn whole_rows(photo: &DecodedPhoto) -> Vec<[usize; 2]> {
    let mut whole = Vec::new();
    let mut from = 0;
    for [first, last] in &photo.damaged_rows {
        if (*first as usize) > from {
            whole.push([from, *first as usize]);
        }
        from = *last as usize;
    }
    if from < photo.grey.height {
        whole.push([from, photo.grey.height]);
    }
    whole
}

/// Some rows of a picture.
fn rows(grey: &Grey, first: usize, last: usize) -> Result<GreyView<'_>> {
    let range = first * grey.width..last * grey.width;
    let samples = match &grey.samples {
        Samples::U8(samples) => SamplesView::U8(samples.get(range).unwrap_or_default()),
        Samples::U16(samples) => SamplesView::U16(samples.get(range).unwrap_or_default()),
    };
    GreyView::new(grey.width, last - first, samples)
}
