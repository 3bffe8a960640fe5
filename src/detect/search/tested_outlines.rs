//! Record of the positions already measured, so that none is measured twice.
//!
//! The levels of the search and the two picture sizes meet the same target again; parts of an outline lead to the same
//! ellipse; specks lie inside of targets. Everything decided is entered into a grid of cells, and a candidate is compared
//! with its neighbours only. Of concentric outlines the inner one is kept: from it the outer rim of a donut is found (`detect/rims.rs`).

use super::blob::NoBlob;
use crate::detect::acceptance::code::SPOT;
use crate::detect::ellipse::outline::Outline;
use crate::detect::search::Candidate;
use crate::detection::{Detection, Polarity, Reason, Rejected, Target};

/// Side of a cell in pixels.
const CELL: f64 = 64.0;

/// An outline that was decided on.
#[derive(Clone, Copy)]
struct TestedOutline {
    outline: Outline,
    bright: bool,
    accepted: bool,
}

/// An entry that touches a cell, and the next one.
#[derive(Clone, Copy)]
struct Link {
    entry: u32,
    next: Option<u32>,
}

/// Whether one outline lies around another, about the same centre.
fn encloses(outer: &Outline, inner: &Outline) -> bool {
    let distance = (outer.u - inner.u).hypot(outer.v - inner.v);
    let (inner, outer) = (inner.semi_axes().0, outer.semi_axes().1);
    distance < 0.1 * inner && inner < 0.9 * outer
}

/// Shows no longer as rejected what was so at a target.
pub(crate) fn forget_rejected(detection: &mut Detection, target: &Target) {
    let outline = Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle);
    let rejected = &mut detection.rejected;
    let reach = target.major / 2.0;
    detection.rejected_blobs.retain(|blob| {
        // nearly all lie far away
        if (blob.u - target.u).abs() > reach || (blob.v - target.v).abs() > reach {
            return true;
        }
        let [c, s] = outline.normalised(blob.u, blob.v);
        let stays = c.hypot(s) > 1.0 || blob.diameter > 3.0 * target.major;
        if !stays && let Some(count) = rejected.get_mut(&blob.reason) {
            *count = count.saturating_sub(1);
        }
        stays
    });
    rejected.retain(|_, count| *count > 0);
}

/// Targets and decided places.
pub(crate) struct TestedOutlines {
    pub targets: Vec<Target>,
    /// Discs that were given up for a spot in their centre, where codes may have such.
    pub grounds: Vec<Target>,
    spots: bool,
    pub detection: Detection,
    entries: Vec<TestedOutline>,
    /// For each cell the last link of its list of entries, if any.
    cells: Vec<Option<u32>>,
    links: Vec<Link>,
    columns: usize,
    rows: usize,
}

impl TestedOutlines {
    /// Of a picture of this size, with nothing in it yet; `spots` where codes may have spots in their dots.
    pub fn new(width: usize, height: usize, spots: bool) -> Self {
        let [columns, rows] = [width, height].map(|size| size / CELL as usize + 1);
        Self {
            targets: Vec::new(),
            grounds: Vec::new(),
            spots,
            detection: Detection::default(),
            entries: Vec::new(),
            cells: vec![None; columns * rows],
            links: Vec::new(),
            columns,
            rows,
        }
    }

    /// Whether nothing was decided about a candidate yet: it is no decided outline again and lies in no target.
    pub fn is_new(&self, candidate: &Candidate) -> bool {
        let outline = &candidate.outline;
        !self.near(outline).any(|entry| {
            let [c, s] = entry.outline.normalised(outline.u, outline.v);
            if entry.accepted {
                !(entry.bright != candidate.bright && encloses(&entry.outline, outline))
                    && c * c + s * s < 0.81
                    && outline.semi_axes().0 < 1.2 * entry.outline.semi_axes().0 + 1.5
            } else {
                let size = entry.outline.semi_axes().0;
                entry.bright == candidate.bright
                    && (entry.outline.u - outline.u).hypot(entry.outline.v - outline.v) < 0.05 * size + 0.3
                    && [entry.outline.p - outline.p, entry.outline.q - outline.q, entry.outline.r - outline.r]
                        .iter()
                        .all(|change| change.abs() < 0.1 * size)
            }
        })
    }

    /// Whether no target is at an outline's centre.
    pub fn is_free(&self, outline: &Outline) -> bool {
        !self.near(outline).any(|entry| {
            let [c, s] = entry.outline.normalised(outline.u, outline.v);
            entry.accepted && c * c + s * s < 1.0
        })
    }

    /// Enters a target that was rejected before: what is shown as rejected there is so no longer.
    pub fn reconsider(&mut self, target: Target, bright: bool) {
        forget_rejected(&mut self.detection, &target);
        self.accept(target, bright);
    }

    /// Enters a target, unless its measurement has led to one that is there already.
    pub fn accept(&mut self, target: Target, bright: bool) {
        let outline = Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle);
        let again = self.near(&outline).any(|entry| {
            entry.accepted
                && entry.bright == bright
                && (entry.outline.u - outline.u).hypot(entry.outline.v - outline.v) < 0.5 * outline.semi_axes().1
        });
        if again {
            return;
        }
        let other = |entry: &&TestedOutline| entry.accepted && entry.bright != bright;
        let inner = self.near(&outline).filter(other).find(|entry| encloses(&outline, &entry.outline));
        if let Some(spot) = inner.map(|entry| entry.outline) {
            if self.is_spot(&spot, &outline) {
                self.grounds.push(target);
                return self.enter(TestedOutline { outline, bright, accepted: false });
            }
            return self.reject(outline, bright, Reason::NotAnEllipse);
        }
        let grounds: Vec<Outline> = self.near(&outline).filter(other).map(|entry| entry.outline).collect();
        for ground in grounds.iter().filter(|ground| encloses(ground, &outline)) {
            let at = self.targets.iter().position(|target| (target.u, target.v) == (ground.u, ground.v));
            let given_up = at.map(|at| self.targets.remove(at));
            for entry in self.entries.iter_mut().filter(|entry| entry.outline == *ground) {
                entry.accepted = false;
            }
            match given_up {
                Some(disc) if self.is_spot(&outline, ground) => self.grounds.push(disc),
                _ => self.count(&NoBlob::of(ground, Reason::NotAnEllipse)),
            }
        }
        self.enter(TestedOutline { outline, bright, accepted: true });
        self.targets.push(target);
    }

    /// Whether codes are read and one outline is small enough to be the spot in the other's centre.
    fn is_spot(&self, inner: &Outline, outer: &Outline) -> bool {
        self.spots && inner.semi_axes().0 < SPOT * outer.semi_axes().0
    }

    /// Enters a target that was found before, so that it is not found again.
    pub fn know(&mut self, target: &Target) {
        let outline = Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle);
        self.enter(TestedOutline { outline, bright: target.polarity == Polarity::Bright, accepted: true });
    }

    /// Enters the outline of a rejected blob.
    pub fn reject(&mut self, outline: Outline, bright: bool, reason: Reason) {
        self.enter(TestedOutline { outline, bright, accepted: false });
        self.count(&NoBlob::of(&outline, reason));
    }

    /// Shows an outline as that of a target that something hides, once, in place of other reasons for this position.
    pub fn hide(&mut self, outline: &Outline) {
        let here = |blob: &Rejected| {
            let [c, s] = outline.normalised(blob.u, blob.v);
            c.hypot(s) < 0.5
        };
        if !self.detection.rejected_blobs.iter().any(|blob| blob.reason == Reason::Occluded && here(blob)) {
            self.count(&NoBlob::of(outline, Reason::Occluded));
        }
    }

    /// Makes room for so many rejected blobs.
    pub fn expect(&mut self, rejected: usize) {
        self.detection.rejected_blobs.reserve(rejected);
    }

    /// Counts rejected blobs that are not shown.
    pub fn add(&mut self, reason: Reason, count: usize) {
        if count > 0 {
            *self.detection.rejected.entry(reason).or_default() += count;
        }
    }

    /// Counts a rejected blob, and keeps it for showing when it could be mistaken for a target.
    pub fn count(&mut self, no: &NoBlob) {
        *self.detection.rejected.entry(no.reason).or_default() += 1;
        let shown = !matches!(no.reason, Reason::TooSmall | Reason::TooLarge);
        if shown && [no.u, no.v, no.diameter].iter().all(|x| x.is_finite()) {
            let NoBlob { u, v, diameter, reason, .. } = *no;
            self.detection.rejected_blobs.push(Rejected { u, v, diameter, reason });
        }
    }

    /// The result, the targets from top to bottom.
    pub fn finish(mut self) -> Detection {
        self.targets.sort_by(|a, b| a.v.total_cmp(&b.v).then(a.u.total_cmp(&b.u)));
        Detection { targets: self.targets, ..self.detection }
    }

    /// Entries that touch the cell in which the outline's centre lies.
    fn near(&self, outline: &Outline) -> impl Iterator<Item = &TestedOutline> {
        let first = self.cells[self.cell(outline.u, outline.v)];
        let link = |at: Option<u32>| at.map(|at| self.links[at as usize]);
        std::iter::successors(link(first), move |found| link(found.next)).map(|link| &self.entries[link.entry as usize])
    }

    /// Enters into every cell that the outline's box touches.
    fn enter(&mut self, entry: TestedOutline) {
        let (half_u, half_v) = entry.outline.half_box();
        let low = self.cell(entry.outline.u - half_u, entry.outline.v - half_v);
        let high = self.cell(entry.outline.u + half_u, entry.outline.v + half_v);
        let number = self.entries.len() as u32;
        self.entries.push(entry);
        for row in low / self.columns..=high / self.columns {
            for column in low % self.columns..=high % self.columns {
                let cell = &mut self.cells[row * self.columns + column];
                self.links.push(Link { entry: number, next: *cell });
                *cell = Some(self.links.len() as u32 - 1);
            }
        }
    }

    /// Index of the cell of a place; places outside of the picture belong to its border.
    fn cell(&self, u: f64, v: f64) -> usize {
        let column = ((u / CELL) as usize).min(self.columns - 1);
        let row = ((v / CELL) as usize).min(self.rows - 1);
        row * self.columns + column
    }
}
