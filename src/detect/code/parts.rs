//! Detections that belong to a coded target besides its dot: parts of the ring, and the spot in the dot's centre.

use std::ops::Range;

use super::outline_of;
use crate::detect::acceptance::code::{
    BEYOND, SECTOR_AREA, SECTOR_CONTRAST, SECTOR_MIDDLE, SECTOR_WIDTH, SECTORS, SPOT, TONE_SMALL,
};
use crate::detect::outline::Outline;
use crate::detect::search::tested_outlines::forget_rejected;
use crate::detection::{CodeCandidate, CodeNote, Detection, Reason, Rejected, Target};
use crate::ring_code::{Design, Family};

/// A dot with the ring around it, of a code that was read or of none: among codes of a family what has all of a ring but a number is one.
fn ringed(target: &Target, family: Option<Family>) -> Option<(Outline, Design)> {
    let note = target.quality.code_note.and(family);
    target.code_family.or(note).map(|family| (outline_of(target), family.design()))
}

/// The families of which a target's ring is a code, or may be. Where the photo's codes are of one, doubts in another tell only what the
/// photos together are.
fn families(target: &Target, family: Option<Family>) -> impl Iterator<Item = Family> {
    let counts = move |c: &&CodeCandidate| c.margin > 0.0 || family.is_none_or(|family| family == c.family);
    target.code_family.into_iter().chain(target.code_candidates.iter().filter(counts).map(|c| c.family))
}

/// Takes out what lies within a ring, in a photo whose codes are of this family: nothing but its sectors and what they leave fits there.
pub(crate) fn drop_parts(detection: &mut Detection, family: Option<Family>) {
    let dots: Vec<_> = detection.targets.iter().filter_map(|target| ringed(target, family)).collect();
    if dots.is_empty() {
        return;
    }
    let is_part = |target: &Target| {
        let outline = outline_of(target);
        let within = |(dot, design): &(Outline, Design)| {
            let [inner, outer] = design.ring();
            let [x, y] = dot.normalised(outline.u, outline.v);
            let widest = (outer - inner) / 2.0 + BEYOND;
            (inner - BEYOND..outer + BEYOND).contains(&x.hypot(y)) && outline.semi_axes().1 < widest * dot.semi_axes().0
        };
        target.code.is_none() && dots.iter().any(within)
    };
    take_out(detection, is_part);
}

/// Removes targets at the sectors of a ring that was not read, and records that for the dot: two or more ellipses in the
/// middle of a ring of some design and about as wide as that. One alone may be any neighbour, unless the ring itself was seen.
pub(crate) fn drop_sectors(detection: &mut Detection) {
    let all = &detection.targets;
    let outlines: Vec<Outline> = all.iter().map(outline_of).collect();
    let mut sectors = vec![false; all.len()];
    let mut dots = Vec::new();
    // the rings of large dots are read, and objects around them are as far apart
    for (k, dot) in all.iter().enumerate().filter(|(_, dot)| dot.minor <= TONE_SMALL) {
        let own = outlines[k];
        let is_sector = |other: &usize, design: Design| {
            let target = &all[*other];
            // between two sectors the background is an ellipse too
            let alike =
                target.contrast > SECTOR_CONTRAST * dot.contrast && dot.contrast > SECTOR_CONTRAST * target.contrast;
            *other != k && target.code.is_none() && alike && is_in_ring(&own, &outlines[*other], design)
        };
        // the design of which there are more: their rings overlap
        let found = [Design::Schneider, Design::Metashape]
            .map(|design| (0..all.len()).filter(|other| is_sector(other, design)).collect::<Vec<_>>());
        let found = found.into_iter().max_by_key(Vec::len).unwrap_or_default();
        let is_ring = dot.quality.code_note.is_some() || !dot.code_candidates.is_empty();
        if !found.is_empty() && (is_ring || found.len() >= SECTORS) {
            found.into_iter().for_each(|sector| sectors[sector] = true);
            dots.push(k);
        }
    }
    for dot in dots.into_iter().filter(|dot| !sectors[*dot]) {
        let target = &mut detection.targets[dot];
        if target.code.is_none() && target.code_candidates.is_empty() {
            target.quality.code_note.get_or_insert(CodeNote::Unread);
        }
    }
    let mut sectors = sectors.into_iter();
    take_out(detection, |_| sectors.next().unwrap_or_default());
}

/// Whether an ellipse may be a sector of the ring around a dot: in its middle, as far across as the ring, and smaller than a neighbour alike.
fn is_in_ring(dot: &Outline, sector: &Outline, design: Design) -> bool {
    let [inner, outer] = design.ring();
    let (middle, width) = ((inner + outer) / 2.0, outer - inner);
    let [x, y] = dot.normalised(sector.u, sector.v);
    let radius = x.hypot(y);
    let ((a, b), (own_a, own_b)) = (dot.semi_axes(), sector.semi_axes());
    if own_a * own_b > SECTOR_AREA * a * b {
        return false;
    }
    let [share, pixels] = SECTOR_MIDDLE;
    if (radius - middle).abs() > share * width + pixels * middle / (a * b).sqrt() {
        return false;
    }
    // half of what it measures along the ray: |A' n| of its rim A (cos t, sin t)', with n the gradient of the dot's radius
    let det = dot.p * dot.q - dot.r * dot.r;
    let [nx, ny] = [(dot.q * x - dot.r * y) / (radius * det), (dot.p * y - dot.r * x) / (radius * det)];
    let half = (sector.p * nx + sector.r * ny).hypot(sector.r * nx + sector.q * ny);
    // both by the same factor where the dot is measured too large or too small
    SECTOR_WIDTH.contains(&(2.0 * half / width * middle / radius))
}

/// Leaves of the targets in this range only those with a ring that is read, or may be, as a code; how many.
pub(crate) fn keep_ringed(detection: &mut Detection, range: Range<usize>, family: Option<Family>) -> usize {
    let is_ringed = |target: &Target| ringed(target, family).is_some() || families(target, family).next().is_some();
    let kept: Vec<Target> = detection.targets.drain(range.clone()).filter(is_ringed).collect();
    let count = kept.len();
    kept.iter().for_each(|target| forget_rejected(detection, target));
    detection.targets.splice(range.start..range.start, kept);
    count
}

/// Puts discs into the place of the spots in their centres, where a code shows that the disc is the target.
///
/// Of concentric outlines the search takes the inner one. The outer ones of tiny ones come here as `grounds`: they were read
/// together with the targets, which they follow from index `from` on.
pub(crate) fn settle_grounds(detection: &mut Detection, from: usize, family: Option<Family>) {
    let grounds = detection.targets.split_off(from.min(detection.targets.len()));
    let has_spot = |target: &Target| families(target, family).any(|family| family.design().spot() > 0.0);
    let (discs, others): (Vec<_>, Vec<_>) = grounds.into_iter().partition(has_spot);
    let targets = detection.targets.iter().filter(|target| has_spot(target));
    let outlines: Vec<_> = discs.iter().chain(targets).map(outline_of).collect();
    if outlines.is_empty() && others.is_empty() {
        return;
    }
    take_out(detection, |target| {
        let in_centre = |disc: &Outline| {
            let [c, s] = disc.normalised(target.u, target.v);
            c.hypot(s) < SPOT && target.major < 2.0 * SPOT * disc.semi_axes().0
        };
        outlines.iter().any(in_centre)
    });
    detection.targets.extend(discs);
    detection.targets.sort_by(|a, b| a.v.total_cmp(&b.v).then(a.u.total_cmp(&b.u)));
    for Target { u, v, major, .. } in others {
        *detection.rejected.entry(Reason::NotAnEllipse).or_default() += 1;
        detection.rejected_blobs.push(Rejected { u, v, diameter: major, reason: Reason::NotAnEllipse });
    }
}

fn take_out(detection: &mut Detection, which: impl FnMut(&Target) -> bool) {
    let (parts, targets) = std::mem::take(&mut detection.targets).into_iter().partition(which);
    detection.targets = targets;
    for Target { u, v, major, .. } in parts {
        *detection.rejected.entry(Reason::CodeRing).or_default() += 1;
        detection.rejected_blobs.push(Rejected { u, v, diameter: major, reason: Reason::CodeRing });
    }
}
