//! Every threshold of the detector.
//!
//! One table a room, in the order in which a picture passes them. A row has a name, a value, and where the value comes from:
//!
//! - `derived`: from an equation or from the geometry of the thing.
//! - `measured`: the value that a measurement has set; the measurement is named.
//! - `judged`: chosen between values that would do, and held by a bench: `detect` (clutter and known discs), `photos` (webcam
//!   grids, pictures without targets, random cameras, conditions) or `codes`. Nothing says that another value would be worse.
//!
//! Lengths are pixels of the picture that is searched, noise is the standard deviation of a pixel. How something is computed (rows
//! looked at, bins, iterations, corrections that end a fit) decides nothing and stays with its algorithm.

/// Where a value comes from.
enum Source {
    Derived,
    Measured,
    Judged,
}

/// Constants, each of which states its source.
macro_rules! table {
    ($($(#[$doc:meta])* $name:ident: $type:ty = $value:expr, $source:ident $reason:literal;)*) => {$(
        $(#[$doc])*
        #[doc = concat!("\n\n", stringify!($source), ": ", $reason)]
        pub(crate) const $name: $type = {
            let _ = Source::$source;
            $value
        };
    )*};
}

/// Sizes that are asked for, in units of the user's own limits: what is not known well yet gets room.
pub(crate) mod size {
    use super::Source;

    table! {
        /// Axis ratio of the search's outlines, known to a part of a pixel, over the least one asked for.
        SEARCHED_FLAT: f64 = 0.76, Judged "0.22 for the usual 0.29: flatter chains of runs are bars";
        /// The same of an ellipse of moments that the search goes on with.
        MOMENTS_FLAT: f64 = 0.7, Judged "moments of a few rows are off by a third of the flat axis";
        /// The same after the first fit through edges.
        FIRST_FLAT: f64 = 0.85, Judged "the first fit has 32 rays";
        /// Longest side of a blob's box over the smallest diameter, and over the largest one with what blur adds.
        BLOB_SMALL: f64 = 0.7, Judged "up to one step of rows is unseen above and below: 1.5 of 5 px";
        BLOB_LARGE: f64 = 1.3, Judged "a third more than asked for is looked at";
        BLOB_GROWN: f64 = 4.0, Judged "two pixels of blur on each side";
        /// Diameter of edges over the smallest and the largest one.
        EDGES_SMALL: f64 = 0.92, Judged "edges of small discs lie further in than the fit finds their rim";
        EDGES_LARGE: f64 = 1.02, Judged "no target of the largest size is lost to the scatter of its edges";
        /// Diameter of a fit over the smallest one.
        FIT_SMALL: f64 = 0.95, Judged "no target of the smallest size is lost to the scatter of its diameter";
        /// Pixels between an outline and the border of the picture.
        ROOM: f64 = 2.0, Derived "bilinear samples and falls over two pixels need them";
        /// Diameter from which on the quartered picture is searched too.
        LARGE: f64 = 40.0, Judged "ten pixels there";
        /// From and up to this share of the asked diameters blobs without a shape are tried by what a photo's targets have in common.
        ALIKE_SMALL: f64 = 0.7, Judged "blur makes small discs look larger, noise smaller";
        ALIKE_LARGE: f64 = 1.5, Judged "as above";
    }
}

/// What a picture is: noise, range, clipping, processing.
pub(crate) mod picture {
    use super::Source;

    table! {
        /// Undershoot, as a share of the step, from which an edge is sharpened.
        SHARPENED: f64 = 0.07, Judged "a lens leaves less; the sharpened webcam pictures of `photos` have 0.27 to 0.55";
        /// Flat sides of steps that are needed to say so.
        STEPS: usize = 24, Derived "the median of 24 has a standard error of a quarter of their scatter";
        /// Least step that is looked at, as a share of the range and in noise, and the fall over two pixels that belongs to it.
        STEP: [f64; 3] = [0.2, 10.0, 0.4], Judged "a fifth of the range is a target's rim in `photos`";
        /// Scatter of a flat side, as a share of the step and in noise.
        FLAT: [f64; 2] = [0.1, 3.0], Derived "4 noise of the least step: four samples of noise have that range once in forty";
        /// Noise, as a share of the range, that hides small targets from the search's own thresholds.
        NOISY: f64 = 0.014, Judged "the threshold of the search is then a tenth of the range: what blur leaves of a small disc";
        /// Share of clipped samples from which paper is over-exposed: of its targets no more than the foot is seen.
        OVEREXPOSED: f64 = 0.4, Judged "paper that fills much of a photo";
        /// Excess of differences at the borders of blocks from which a picture is a compressed one.
        COMPRESSED: f64 = 0.12, Judged "what is not compressed shows at most some hundredths by chance";
        /// Standard errors by which borders of blocks stand out of their neighbours.
        CERTAIN: f64 = 4.0, Derived "chance: 3 in 100,000 pictures";
        /// Samples of a picture of two levels that differ from all four neighbours: their share of the changes along rows, and of all, from
        /// which they are the dots of a dithering.
        DOTTED: f64 = 0.15, Derived "thresholds at random make 0.25 of a middle grey, patterns and error diffusion more";
        DOTS: f64 = 0.005, Judged "specks of a scan are fewer, a grey disc of a hundredth of the picture has as many";
        /// Second differences that are enough where most of the picture is clipped.
        ENOUGH: u64 = 400, Derived "their quartile is good to 9 %";
        /// Most grey levels, and noise, of a drawing without soft edges.
        FEW: usize = 8, Judged "drawings and screenshots have few";
        DRAWN: f64 = 0.5, Derived "rounding alone leaves 0.29";
        /// Samples at the largest level that pile up, and how many times those of the four levels next to it they are.
        PILE: u32 = 20, Judged "fewer tell nothing";
        PILED: u32 = 2, Judged "a histogram of noise and light does not do that at its end";
        /// Smallest edge that counts: in noise, as a share of the range, in grey levels.
        EDGE: [f64; 3] = [3.0, 0.015, 2.5], Derived "the fall between two bilinear samples has 0.94 of the noise: chance passes once in 1400 places";
        /// Smallest difference over three pixels that starts an edge of the search, in the same units.
        SEARCHED: [f64; 3] = [6.5, 0.03, 5.0], Derived "4.6 sigmas of a difference of two samples: chance passes four times in a million";
        /// The same in the quartered picture, whose noise is less than half.
        QUARTERED: [f64; 3] = [3.0, 0.03, 4.0], Derived "six sigmas: means of eight samples have 0.35 of the noise";
        /// Strong differences, as shares of the picture's range: what lies before a target in a tone between its own and the paper's has
        /// weaker edges than the target.
        STRONG: [f64; 2] = [0.45, 0.65], Measured "targets behind cables of `photos -- conditions`: of 1200 1134 are found or told as hidden instead of 1064; 0.15 to 0.75 tried";
        /// Least rise of the edges of every target found, in the second level of the search, for which covered ones are not looked for
        /// on the lowest.
        FAINTER: f64 = 1.4, Judged "covered ones may be fainter than those that are seen: what shades one often covers it";
        /// Least semi-minor axis, and contrast, of rims that tell of a sharpening.
        RIM: f64 = 5.0, Judged "smaller insides have no level of their own";
        RIM_CONTRAST: f64 = 8.0, Derived "rounding is then a sixteenth of the profile";
        /// Amount below which no sharpening is undone.
        LITTLE: f64 = 0.15, Judged "the fit of a rendered ellipse takes it for a lens";
        /// Share of the residual that a sharpening has to explain.
        EXPLAINED: f64 = 0.3, Judged "random cameras of `photos` with and without a sharpening";
        /// Rims that are enough for the profile across them.
        RIMS: usize = 120, Judged "more change the mean profile by less than what is modelled of it";
        /// Largest share of clipped samples at a distance from the rim.
        CLIPPED_RIM: f64 = 0.1, Judged "the mean of the others is then low by little";
        /// Amount from which on a fit is none of a sharpening.
        STRONGEST: f64 = 6.0, Judged "three times the strongest of `photos`; more is a fit gone astray";
        /// Sigma of the mean in which what is sharpened is searched.
        SOFT: f64 = 1.6, Measured "the middle of the range in which the webcam pictures of dots in `photos` show all of them";
        /// The same where the sharpening is undone.
        RESTORED: f64 = 0.7, Judged "what is left of the picture's own blocks and ringing";
        /// Least noise of such a picture, in levels of the one it was made of.
        ROUNDED: f64 = 0.3, Derived "rounding leaves 0.29";
        /// Amount of a sharpening from which rims say that there may be more than the rows do.
        BY_RIMS: f64 = 0.3, Judged "twice what a fit takes for a lens";
    }
}

/// How blurred a target is, and from where on that asks for something else.
pub(crate) mod blur {
    use super::Source;

    table! {
        /// What is assumed of a target before its blur is known, sigma in pixels.
        SHARP: f64 = 0.9, Judged "a lens in focus";
        /// Blur from which on the surround begins further out.
        BLURRED: f64 = 1.2, Judged "the foot of the edge then reaches into the first ring";
        /// Blur from which on a target's edges are refined before they are judged.
        SOFT: f64 = 1.3, Judged "the steepest place scatters by more than edges may differ";
        /// Blur from which on its edges are searched between means.
        DEFOCUSED: f64 = 2.0, Judged "no place of an edge is the steepest within the noise";
    }
}

/// What a place is measured from, and which place is meant.
pub(crate) mod place {
    use super::Source;

    table! {
        /// Distance of two measurements of the same disc in the smaller semi-minor axis, and ratio of their semi-major axes.
        SAME: [f64; 2] = [0.25, 1.4], Judged "two discs that touch are two radii apart";
        /// Least and largest standard deviation of the window of a lump, in those of the picture's blur.
        NARROWEST: f64 = 0.7, Judged "a point spread function is no narrower, noise is";
        WIDEST: f64 = 5.0, Judged "what is wider has a rim, and is measured by it";
        /// Level above the background from which a pixel is weighted, as a share of the contrast and in noise.
        WEIGHTED: [f64; 2] = [0.15, 3.0], Judged "noise of the background stays out";
        /// Square of a gradient from which it is weighted, in squares of the noise.
        STEEP: f64 = 9.0, Derived "noise alone has a mean of 1: chance passes once in 8000 pixels";
        /// Distance at which a click beside a target still means it.
        BESIDE: f64 = 4.0, Judged "a hand on the mouse";
    }
}

/// Blobs of the search.
pub(crate) mod blob {
    use super::Source;

    table! {
        /// Departure of a blob's area from that of the ellipse of its moments, of few rows and of more.
        FILL_OF_FEW: f64 = 0.45, Judged "up to one step of two or three is unknown";
        FILL: f64 = 0.12, Derived "a triangle departs by 0.17, a bowl by more; a square, 0.05, goes by its ends";
        /// Area, in units of that of the runs, from which on an ellipse through their ends follows a bar instead.
        UNSEEN: f64 = 2.5, Judged "bars of `detect`";
        /// Rms of ends from their ellipse: pixels, and share of its semi-minor axis.
        RMS: [f64; 2] = [0.3, 0.05], Judged "ends are good to a tenth of a pixel; letters and corners of `detect` leave more";
        /// Ratio of the wide parts of two touching targets to the neck between them.
        NECK: f32 = 1.5, Judged "touching discs of `detect`";
        /// Least ratio of the lengths of runs that belong together, and what their ends may be apart: pixels, and share of the shorter.
        LINKED: f32 = 0.35, Judged "clutter and discs of `detect`";
        APART: [f32; 2] = [4.0, 0.25], Judged "as above";
        /// What a spot may take of a run, and how far its middle may lie from that of the run above, as shares of the run.
        SPOT: [f32; 2] = [0.3, 0.15], Judged "the spot of Metashape's dots, 0.09, grows by blur and sharpening: `prints`";
    }
}

/// Ellipses that most of a blob's border follows.
pub(crate) mod partial {
    use super::Source;

    table! {
        /// Share of the ends in one window.
        WINDOW: f64 = 0.5, Judged "what is covered or joined on one side leaves more of the border in one piece";
        /// Least share of the ends that follows the ellipse.
        FOLLOWING: f64 = 0.55, Judged "a cover of a fifth of the diameter on one side hides all ends but these";
        /// Least share of an ellipse's width and of its height that the blob reaches over.
        SPANNED: f64 = 0.35, Derived "a cable of a fifth of the diameter across the middle leaves halves of 0.4, less room for their ends";
        /// Distance in which ends follow an ellipse: pixels, and share of its semi-minor axis; and that of the worst window's.
        GOOD: [f64; 2] = [0.3, 0.03], Judged "as the ends of a whole blob, less room for its shape";
        HOPELESS: f64 = 3.0, Judged "of windows with a piece of the cover one is nearer";
        /// Distance by which ends differ in any case.
        STEPS: f64 = 0.15, Judged "rows are whole";
        /// Smallest minor axis, and fewest runs: what is smaller has too few ends.
        SMALLEST: f64 = 7.0, Judged "smaller ones have too few ends";
        RUNS: usize = 4, Derived "half of their ends are four, with the next ones enough for five unknowns";
    }
}

/// Blobs that are wider where a target is.
pub(crate) mod bulge {
    use super::Source;

    table! {
        /// Least width of a target's rows over that of the others.
        WIDER: f32 = 1.4, Judged "a cable is at most half as wide as what it crosses; less are bends and steps of a bar";
        /// Shares of the rows up to which they may be the narrow ones, one after the other.
        NARROW: [f64; 3] = [0.1, 0.3, 0.5], Judged "a cable that ends at the target's rim, one as long as the target beyond it, and longer";
    }
}

/// Targets that something divides: two blobs and their convex hull.
pub(crate) mod halves {
    use super::Source;

    table! {
        /// Least area of the smaller part in that of the larger: with less the larger shows the ellipse by itself.
        SMALLER: f64 = 0.15, Judged "a cable next to the rim";
        /// Shortest part, in the smallest minor axis.
        SHORTEST: f64 = 0.8, Judged "the longer side of a half is the diameter";
        /// Least length of the shorter part in that of the longer.
        SHORTER: f64 = 0.4, Judged "both lie along the cable; the smaller one is short where it is small";
        /// Largest distance between the parts, in the size of the larger.
        GAP: f64 = 0.3, Derived "a cable of a fifth of the diameter, and its blur";
        /// Least share of the hull that both fill.
        AREA: f64 = 0.6, Derived "such a cable takes a quarter of a circle, and blur a little more";
        /// Largest share of their bounding box that both fill.
        FULLEST: f64 = 0.8, Derived "an ellipse fills π/4 of its own";
        /// By how much the hull's area may differ from that of its ellipse, in addition to a quarter of the rows.
        FILL: f64 = 0.06, Judged "corners every second row";
        /// Least share of the hull's corners that follows the ellipse.
        FOLLOWING: f64 = 0.8, Judged "the parts' own corners are rounded off";
    }
}

/// The first look at a blob: sixteen directions, two pixels each.
pub(crate) mod look {
    use super::Source;

    table! {
        /// Distance of the outer pixel from the rim.
        OUTSIDE: f64 = 2.5, Judged "beyond the blur of a sharp photograph";
        /// Directions in which the step may be missing: of small blobs and of others.
        MISSING_SMALL: u32 = 3, Measured "none of 2600 targets in thirteen pictures goes, a quarter of the clutter of `detect` does";
        MISSING: u32 = 7, Derived "0.42 of the outline may be missing";
        /// Minor axis of small blobs in units of the smallest that may have a gap.
        SMALL: f64 = 0.8, Judged "the search knows sizes to a fifth";
        /// Directions that may lead out of the shape: at first, after the outline is known, and in the same look with a small gap.
        OPEN: u32 = 5, Judged "bowls and joined strokes of `detect`";
        OPEN_MEASURED: u32 = 3, Judged "as above, with the outline through edges";
        MISSING_WHOLE: u32 = 2, Derived "a tenth of sixteen directions";
        /// Directions in which step and inside may fail where a sector is covered.
        COVERED: u32 = 8, Judged "covers of a fifth of the diameter, `photos -- conditions`";
        /// Mean step of the better twelve directions, in noise.
        FAINT: f64 = 3.3, Derived "eight sigmas of a mean of twelve differences, of which the choice of the better ones takes some";
        /// Step from which noise makes no holes in it, and places in which it may then be missing.
        CLEAR: f64 = 6.0, Derived "of such a step noise leaves less than 0.4 once in 190 directions";
        GAPS: u32 = 2, Derived "a cable runs across a target's outline twice";
        /// Share of the typical step that is a step.
        STEP: f32 = 0.4, Judged "light, blur and noise change a step by less";
        /// Difference from the inside's level, as a share of the typical step, that is the inside going on.
        OWN: f32 = 0.3, Judged "less than the least step";
        /// Directions in which the inside may be darker than elsewhere, and as many in which it may be brighter: of a blob, and of one of which a sector
        /// is covered.
        STRANGE: [usize; 2] = [2, 3], Measured "a cable as bright as paper across the middle: of 600 discs behind cables 6 more are found or told as hidden";
        /// Spread of the inside, as a share of the typical step.
        EVEN: f32 = 0.8, Judged "a spot or a shadow takes less";
        /// Difference from both levels, as a share of the contrast, of what lies in front of a target.
        FOREIGN: f64 = 0.3, Judged "what differs less is taken for the target's own blur";
        /// Share of the contrast from the target's level at which a stroke comes back.
        COMES_BACK: f64 = 0.5, Derived "half-way";
    }
}

/// Edges and the ellipse through them.
pub(crate) mod outline {
    use super::Source;

    table! {
        /// Smallest distance that a point may always have, and largest one in robust standard deviations.
        TOLERANCE: f64 = 0.25, Judged "blur, printing and pixels move edges by that without noise";
        SIGMAS: f64 = 3.0, Derived "of 48 rays chance takes one in every eighth outline";
        /// Blur s moves the steepest place of a rim of curvature κ inwards by about κ s² / 2: so much, in square pixels, is allowed for at
        /// the tips of a slender ellipse.
        BENT: f64 = 0.4, Derived "half the square of a blur of 0.9 px";
        /// Largest share of the outline that may be missing in one piece without further demands; many small gaps count as so much more.
        SMALL_GAP: f64 = 0.1, Judged "counters and bowls of `detect` have more";
        SCATTERED: f64 = 0.6, Judged "as above";
        /// Largest share of the outline that may be missing at all, and what a first fit may have more.
        HIDDEN: f64 = 0.42, Judged "most of the outline is seen";
        HIDDEN_FIRST: f64 = 0.1, Judged "the second round decides";
        /// Smallest minor axis of a target with a gap, and that of a first outline with a gap that may become small.
        GAP_MINOR: f64 = 12.0, Judged "the letters of `detect` that have an ellipse with a gap are smaller";
        GAP_MINOR_FIRST: f64 = 0.9, Judged "the first outline is good to a tenth";
        GAP_FIRST: f64 = 2.0, Judged "as above";
        /// Contrast of a target with a gap, in noise.
        GAP_CONTRAST: f64 = 20.0, Derived "edges are then good to a seventh of a pixel";
        /// What noise n does to the steepest place of an edge of contrast C, in units of n / C, at least.
        SPREAD: f64 = 2.8, Judged "1.7 for a sharp edge, and room for other profiles";
        /// The same of a blur: times its cube, at most times itself; and of a fitted profile, times its root.
        SPREAD_CUBE: f64 = 1.2, Derived "sqrt(6) n over twice the second derivative of the fall, 0.8 C / s³, samples drawn from four pixels";
        SPREAD_WIDE: f64 = 4.0, Derived "the fall between means of s samples";
        SPREAD_FITTED: f64 = 1.9, Derived "sqrt(2 sqrt(π))";
        /// Departure of a good outline without noise, as a share of its semi-minor axis.
        SHAPE: f64 = 0.02, Judged "printing, compression and the picture's grid add up to 1 % of the diameter";
        /// Scatter of the edges over what is expected, of an outline that is judged alone; of a first one with its floor in pixels.
        SCATTER: f64 = 1.1, Judged "the expectation has room of its own";
        SCATTER_FIRST: f64 = 1.3, Judged "as above, before the blur is known";
        SCATTER_FLOOR: f64 = 0.05, Judged "a first fit has made one correction";
        /// What a first outline of a small semi-minor axis may scatter more, and that axis.
        SCATTER_SMALL: f64 = 0.2, Measured "0.36 px in one of 2500 isolated circles of 5 px";
        SMALL: f64 = 5.0, Judged "the search knows the height of so few rows to two pixels only";
        /// Rms of edges from an outline beyond which it is none: pixels, and share of its semi-minor axis.
        RMS: [f64; 2] = [0.3, 0.03], Judged "an outline that no expectation saves";
        /// Rays in a row without a fitting edge that are something in front of the target.
        COVERED: usize = 3, Judged "one edge out of place is chance, two in a row are seldom";
        /// Distance, in pixels, from which a single edge that does not fit is something in front as well; and the scatter of the others up to
        /// which it is no chance.
        GONE: f64 = 0.5, Measured "error over sigma of 380 discs behind thin cables 1.20, with half as much again 1.28";
        EVEN: f64 = 0.1, Measured "with more, coarse JPEG and drawings lose edges that are their own, `photos -- conditions`";
        /// Change of an outline up to which its edges are not looked for again.
        HEAD_ON: f64 = 0.4, Judged "rays meet the rim as head on as before";
    }
}

/// Grey levels in and around an outline.
pub(crate) mod levels {
    use super::Source;

    table! {
        /// Contrast of a target: in noise around it, where that is no more than so many times the picture's and levels.
        CONTRAST: f64 = 4.0, Judged "fainter discs have no outline";
        DISTURBED: [f64; 2] = [4.0, 2.0], Judged "more is texture and no noise";
        /// Contrast times minor axis, in noise and pixels: what is smaller or fainter has too few pixels that differ from a letter's inside.
        SHAPELY: f64 = 100.0, Judged "letters of `detect`";
        /// Contrast, in noise, below which noise hides what tells a letter's inside from an ellipse.
        FAINT: f64 = 25.0, Judged "as above";
        /// Most of sixteen directions in which a faint target may lie inside of a thin ring.
        STROKE: u32 = 11, Judged "the ring of a code comes back in fewer, the stroke of a letter in nearly all";
        /// Largest share of the inside that may differ from the rest, by a third of the contrast.
        UNEVEN: f64 = 0.25, Judged "what hides more is reported as hidden";
        /// Largest share of the outline that may be missing without anything in front of it.
        UNEXPLAINED: f64 = 0.2, Measured "0.1 costs 0.07 of the hidden targets of `photos -- conditions`";
        /// Noise that is believed of a surround, in units of the picture's; and at least, in the distance of two levels.
        BELIEVED: f64 = 1.1, Judged "where the surround is not plane, what the whole picture has is believed";
        ROUNDING: f64 = 0.3, Derived "rounding leaves 0.29";
        /// Least part of the rays that a ring of the surround has, in tenths.
        RING_TENTHS: f64 = 6.0, Judged "the plane stands on more than one side of the target";
        /// Least noise by which a ring is judged; rms and mean, in that noise, with which it still belongs to the plane.
        RING_NOISE: f64 = 0.5, Derived "rounding leaves 0.29, and a plane is no background to a fraction of a level";
        RING: [f64; 2] = [1.7, 0.9], Judged "the foot of a neighbour's edge shows in the mean first";
    }
}

/// Light that changes across a target.
pub(crate) mod light {
    use super::Source;

    table! {
        /// Standard deviation of the light's change from pixel to pixel, as a share of it.
        STEEPEST: f64 = 0.02, Judged "a tenth across a target of 5 px: more is a shadow's edge";
        /// Least semi-minor axis in pixels, and redundancy, of the part of a disc that shows the light inside.
        CORE: [f64; 2] = [1.5, 6.0], Judged "fewer pixels know less of it than the background";
        /// Variance of a slope, in square grey levels a pixel, that no picture is free of.
        FLOOR: f64 = 1e-8, Judged "a thousandth of a level across a target: drawings without noise have no variance";
    }
}

/// The fit of a rendered ellipse.
pub(crate) mod fit {
    use super::Source;

    table! {
        /// Least rise of the level beside a target that is something standing there: share of the contrast, and rms of the fit.
        RISE: [f64; 2] = [0.1, 5.0], Derived "the range of six bilinear samples of noise exceeds five deviations on one of 48 rays of every hundredth target";
        /// Residual beyond which a pixel is not the target's: in noise, least noise, and share of the contrast for a lens, a drawing,
        /// an edge sharper than any rendered.
        OUTLIER: f64 = 5.0, Derived "of a thousand pixels chance takes none";
        QUIET: f64 = 0.5, Judged "rounding and a little more";
        LENS: f64 = 0.06, Judged "a lens does that all around";
        STAIRS: f64 = 0.7, Judged "a pixel of stairs is wrong by up to a half";
        SHARP: f64 = 0.1, Derived "it leaves up to 0.4 of the least blur, 0.2 px, in a pixel";
        /// Departure of a rim from its ellipse that is its own shape, in the rms of the edges from it.
        DEPARTS: f64 = 3.0, Derived "a wave departs by 1.4 of its rms, and noise of an edge seldom by 3; without it discs out of round by 0.5 % of 60 px are told as hidden at low noise";
        /// The same of the flat parts: in noise, least noise, share of the contrast inside.
        FLAT: [f64; 3] = [4.0, 0.6, 0.05], Derived "chance takes 6 of 100,000 flat pixels";
        /// Largest share of the rim's pixels that may be left out.
        DISTURBED: f64 = 0.12, Judged "a small gap and a neighbour";
        /// Rms of the residuals: in noise, and share of the contrast of photos and of drawings.
        RMS_NOISE: f64 = 1.5, Judged "noise that grows with the light";
        RMS_PROFILE: f64 = 0.1, Judged "a lens over the whole band";
        RMS_STAIRS: f64 = 0.25, Judged "the same for stairs";
        /// Part of the residuals that noise does not explain and that differs around the rim, as a share of the contrast: of a minor
        /// axis of 10 px, its growth a pixel, and at most.
        MISFIT: [f64; 3] = [0.045, 0.006, 0.12], Judged "letters against discs of `detect`; large targets show what print and lens do";
        MISFIT_MINOR: f64 = 10.0, Judged "as above";
        /// The same of faint targets is smaller: contrast in noise from which on it is whole, and least share.
        MISFIT_FAINT: f64 = 40.0, Judged "on faint targets noise hides both";
        MISFIT_LEAST: f64 = 0.4, Judged "as above";
        /// The same of a drawing, and of a target with a gap.
        MISFIT_STAIRS: f64 = 0.2, Judged "drawn discs";
        MISFIT_GAP: f64 = 0.024, Judged "the bowl of a letter is an ellipse with a gap too: the rest must be as good as noise allows";
        /// Sum of the squares of scatter and misfit, each over its limit.
        TOGETHER: f64 = 1.15, Judged "the limits are those of each alone";
        /// Largest way of the centre: pixels, and share of the semi-minor axis.
        MOVED: [f64; 2] = [1.0, 0.1], Judged "edges are better than that";
        /// Largest share of a whole outline that chance may hide; gap inside of a ring, in pixels, that is worth a narrower ground.
        WHOLE: f64 = 0.05, Judged "two of 48 rays";
        NARROW: f64 = 1.0, Judged "one pixel of ground";
        /// Depth, in blurs, up to which a cap beyond a cable is left out.
        SHALLOW: f64 = 1.0, Judged "less of it has no edge of its own, and more leaves too little of small discs: `photos -- conditions`";
        /// Standard error of a centre, in pixels, of which too much is hidden.
        UNTOLD: f64 = 0.25, Judged "a hand points as well";
        /// Fewest pixels, unknowns being ten.
        PIXELS: usize = 24, Derived "14 of redundancy";
        /// Contrast of what is clipped, in units of what the scale shows: at most, from which on nothing of the rim is left, and at least then.
        OVEREXPOSED: f64 = 16.0, Judged "the centre hardly depends on it: the image of an ellipse is symmetric about it";
        STEP_LEFT: f64 = 0.97, Judged "at the largest contrast the rim is a step, whose sigma would promise too much";
        STEP_LEAST: f64 = 2.0, Judged "half of the profile shows";
        /// Share of the scale from which a bright target is taken to be clipped, and share of clipped pixels that explains why one has no fit.
        CLIPPED: f64 = 0.9, Judged "contrast and blur begin to stand for each other";
        MOSTLY_CLIPPED: f64 = 0.5, Judged "half of its pixels";
        /// Blur of a lens in focus and its spread over lenses; and the standard deviation, in units of what is seen of it, of a contrast of
        /// which nothing is known. Neither is correlated with the centre.
        IN_FOCUS: [f64; 2] = [0.8, 0.25], Judged "lenses in focus, with the pixel";
        LOOSE: f64 = 100.0, Derived "no information";
        /// Variance of what the fit leaves, over that of the noise, from which the rest is looked at; correlation of neighbours from which
        /// it is no noise (of light, say); and pixels that then move the centre as one.
        UNEXPLAINED: f64 = 1.7, Judged "beyond the noise of light";
        /// Residuals, in variances of the noise, from which the rim may have a shape of its own.
        SHAPED: f64 = 1.1, Derived "a shape that leaves less moves a centre by less than its sigma; to look for it costs a tenth of the time";
        SHARED: f64 = 0.15, Judged "noise of single pixels has less";
        MOVED_TOGETHER: f64 = 3.0, Measured "error over sigma of cameras moved by 2 to 6 px, `photos -- conditions`";
    }
}

/// Targets of which something in front covers a part.
pub(crate) mod covered {
    use super::Source;

    table! {
        /// Sectors tried: shares of the outline.
        SECTORS: [f64; 3] = [0.15, 0.25, 0.35], Derived "a cover of a fifth of the diameter takes 0.295 of a circle's";
        /// Scatter of edges below which one sector is as good as another.
        EVEN: f64 = 0.02, Judged "less tells no sector from another";
        /// Share of the other edges that may not fit either.
        OTHERS: f64 = 0.1, Judged "as the small gap";
        /// Distance from the outline up to which an edge is the target's own.
        FITTING: f64 = 0.2, Judged "hidden targets of `photos -- conditions`";
        /// Smallest minor axis of what is shown as hidden.
        SMALLEST: f64 = 7.0, Judged "as that of a partial ellipse";
        /// Scatter, relative to what is expected of a good outline, of one that is shown as hidden.
        CLEAR: f64 = 0.7, Judged "no false target in conditions, pictures without targets and `detect`";
    }
}

/// Donuts.
pub(crate) mod rims {
    use super::Source;

    table! {
        /// Distance from a hole's centre, in its semi-major axes, up to which the outer rim is looked for.
        FARTHEST: f64 = 12.0, Judged "the spot in the centre of Metashape's dots is an eleventh; without a limit every dot would be looked around to the end of the picture";
        /// Share of the hole's contrast that comes back beyond the disc, and the same in noise.
        RETURNS: f64 = 0.4, Judged "what stands around a donut may be a little more like it than its hole is; as the least step of a look";
        CLEAR: f64 = 6.0, Derived "chance passes nowhere on 48 rays of a hundred places";
        /// Share of the rays on which it does, and how far these places may be from their median radius.
        SEEN: f64 = 0.8, Judged "a gap of a tenth, and a neighbour";
        ROUGH: f64 = 0.3, Judged "a hole aside by a tenth moves the rim by less";
        /// Distance of the two centres, in the outer semi-minor axis, up to which they are rims of one donut.
        CONCENTRIC: f64 = 0.15, Judged "more is a disc with a mark on it";
        /// Square of the distance of the centres, in their standard errors, from which they differ.
        OFF: f64 = 13.8, Derived "99.9 % of χ² of two degrees of freedom";
    }
}

/// Targets of a photo by what the others have in common.
pub(crate) mod alike {
    use super::Source;

    table! {
        /// Fewest targets that tell of the others, and their least minor axis in blurs.
        ENOUGH: usize = 6, Judged "fewer tell no spread";
        PLAIN_MINOR: f64 = 5.0, Derived "the middle of such a disc shows 0.96 of its contrast";
        /// Blur, in pixels, from which small discs of a picture that is neither sharpened nor compressed are looked for too.
        SWALLOWING: f64 = 1.3, Derived "a disc of 5 px then shows less than 0.85 of its contrast, and no flat part";
        /// Residuals of a picture's targets, in noise of its flat ground: from where on their neighbours may share them, and from where on
        /// they hide targets.
        NOISY_RIMS: [f64; 2] = [1.3, 2.0], Judged "in-camera denoising leaves noise at edges: without the first, errors are 2.5 sigmas; without the second, `edge_noise.png` of the cases loses 22 of 35 dots";
        /// Largest ratio of contrasts of a photo's targets.
        CONTRASTS: f64 = 2.5, Judged "light falls off, and so does what blur leaves of the smallest; 40 random cameras of `photos`";
        /// Share of its contrast that a disc shows in its middle below which blur has swallowed it, and the ratio of contrasts then.
        SEEN: f64 = 0.9, Derived "no pixel shows the contrast itself";
        CONTRASTS_SWALLOWED: f64 = 1.75, Measured "of 1900 targets found so in random cameras and webcam grids of `photos` three true ones are fainter, and one that is none";
        /// Least standard deviations of blur and of contrast among targets, as shares.
        BLURS: f64 = 0.06, Judged "as above";
        SHADES: f64 = 0.15, Judged "as above";
        /// Largest residuals, in units of those of the known targets, part of the contrast that they may differ by besides, and the
        /// uneven part in the same units.
        AS_GOOD: f64 = 1.5, Judged "as above";
        PROFILE: f64 = 0.04, Judged "as above";
        UNEVEN: f64 = 0.6, Judged "as above";
        /// Residuals, in units of these largest ones, from which a fit is given up; and where the contrast is not that of the known
        /// targets but what the fit itself promises.
        HOPELESS: f64 = 2.0, Judged "what the first correction promises is that near to what the last one leaves";
        HOPELESS_OWN: f64 = 3.0, Measured "of 879 targets found so in a hundred pictures of `photos` none promised more than 2.7 on its way";
        /// Contrast that blur leaves in the middle, in units of the residuals; and of the whole disc, times the root of its pixels.
        PLAIN: f64 = 4.0, Judged "chance has such shapes below; pictures without targets of `photos`";
        CLEAR: f64 = 16.0, Judged "as above";
        /// Share of the light expected at a place that is enough to fit it.
        LIGHT: f64 = 0.5, Judged "the level around is rough";
        /// Share of its contrast that a quarter of the directions around a disc still show, and an eighth of them, from which it is joined
        /// to something.
        JOINED: [f64; 2] = [0.6, 0.9], Measured "of 1925 targets found so in `photos 100` and `conditions` at most 0.52 and 0.76; of 2400 other shapes of det1.camera.jpg seven in ten have more";
        /// Least semi-minor axis, in blurs, of a disc that is measured on the gap before a ring alone; and how far from the ring, in blurs,
        /// that gap ends.
        GAP: f64 = 3.0, Measured "error over sigma of 1000 small coded dots of sharpened and compressed photos: 1.0 to 1.5 above, 2.7 and more below";
        RING_APART: f64 = 1.2, Derived "blur leaves there an eighth of the ring's contrast, and less further in";
        /// Largest one, in blurs, that is looked for in a ring alone.
        LARGEST: f64 = 8.0, Measured "of 1700 small coded dots found so all but a handful, whose rings are read as none, are smaller";
        /// Most of the contrast that the gap may lack in some direction.
        GAP_LACKS: f64 = 0.5, Derived "half-way";
        /// Largest share of pixels that neighbours may disturb.
        DISTURBED: f64 = 0.25, Judged "neighbours at a pitch of 2.5 radii, `photos -- conditions`; 0.45 shows a false target more in two of the webcam grids";
        /// Departure of the blur: in standard deviations, and as a share.
        BLUR: [f64; 2] = [3.0, 0.1], Judged "chance, and focus over the photo";
        /// Way of the centre from what stands out: pixels, and share of the semi-minor axis; while it is fitted twice that.
        MOVED: [f64; 2] = [1.0, 0.3], Judged "40 random cameras of `photos`";
        /// Part of the known contrasts, from the faintest, that a softened picture's finds may be fainter than.
        FAINTEST: usize = 10, Measured "counters of five pale letters in det1.camera.jpg";
    }
}

pub(crate) mod code;

/// Targets on a sensor's own samples.
pub(crate) mod sites {
    use super::Source;

    table! {
        /// Deviations from the model, and share of the contrast, beyond which a site is not the target's.
        FAR: f64 = 4.5, Derived "of a thousand sites chance takes none";
        LENS: f64 = 0.05, Judged "as that of pictures";
        /// Largest share of sites that may be left out.
        DISTURBED: f64 = 0.3, Judged "neighbours and dirt count here, beyond the rim too";
        /// Contrast of what is clipped, in units of what the scale shows.
        OVEREXPOSED: f64 = 16.0, Judged "as that of pictures";
        /// Largest residuals that a model of two levels explains: noise and share of the contrast.
        EXPLAINED: [f64; 2] = [1.5, 0.1], Judged "as those of pictures";
        /// Deviations of the noise below the white level from which a site counts.
        WHITE: f64 = 3.0, Derived "of 700 such sites noise clips one";
        /// Noise by which a hot site is brighter than all its neighbours, and how many times as bright.
        HOT: f64 = 8.0, Derived "chance: none of 10^14 sites";
        HOT_TIMES: f64 = 2.0, Judged "no light does that from one site to the next";
        /// Standard error of the readout's variance, as a share of it, up to which it is told.
        TOLD: f64 = 0.5, Derived "its root is then good to a quarter";
    }
}

/// Colours apart.
pub(crate) mod colours {
    use super::Source;

    table! {
        /// Fewest targets that show a lateral chromatic aberration of four unknowns.
        FEWEST: usize = 6, Judged "twelve equations for four unknowns";
        /// Residuals in standard errors beyond which a target takes no part.
        FAR: f64 = 4.0, Derived "chance: 6 in 100,000";
        /// Difference that no lens makes: another target.
        BEYOND: f64 = 6.0, Judged "lenses leave up to three pixels in a corner";
    }
}
