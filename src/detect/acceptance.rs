//! Every threshold of the detector.
//!
//! One table per step of the detection, in the order of the steps. A row has a name, a value, and the source of the value:
//!
//! - `derived`: from an equation or from geometry.
//! - `measured`: set by a measurement, which is named.
//! - `judged`: chosen from a range of suitable values, and checked by a bench: `detect` (clutter and known discs), `photos` (webcam
//!   grids, pictures without targets, random cameras, conditions) or `codes`. Another value may be as good.
//!
//! Lengths are pixels of the picture that is searched, noise is the standard deviation of a pixel. Parameters of the computation (rows
//! examined, bins, iterations, convergence limits) reject no target and are in the files of their algorithms.

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
        /// Minimum axis ratio of the search's outlines, over the user's minimum.
        SEARCHED_FLAT: f64 = 0.76, Judged "0.22 for the usual 0.29: flatter chains of runs are bars";
        /// Minimum longest side of a blob's box over the smallest diameter, also of half outlines and of blobs fitted with the blur of the photo's
        /// other targets; maximum over the largest diameter.
        BLOB_SMALL: f64 = 0.7, Judged "up to one step of rows is unseen above and below: 1.5 of 5 px";
        BLOB_LARGE: f64 = 1.3, Judged "a third more than the user's maximum";
        /// Minimum diameter of the ellipse through edges, over the smallest diameter.
        EDGES_SMALL: f64 = 0.92, Judged "edges of small discs lie further in than the fit finds their rim";
        /// Diameter of a fit over the smallest one.
        FIT_SMALL: f64 = 0.95, Judged "no target of the smallest size is lost to the scatter of its diameter";
        /// Minimum distance of an outline from the border of the picture, pixels.
        ROOM: f64 = 2.0, Derived "bilinear samples and falls over two pixels need them";
        /// Diameter from which the picture reduced to a quarter is searched too.
        LARGE: f64 = 40.0, Judged "ten pixels there";
    }
}

/// What a picture is: noise, range, clipping, processing.
pub(crate) mod picture {
    use super::Source;

    table! {
        /// Undershoot, as a share of the step, from which an edge counts as sharpened.
        SHARPENED: f64 = 0.07, Judged "a lens leaves less; the sharpened webcam pictures of `photos` have 0.27 to 0.55";
        /// Flat sides of steps that are needed to say so.
        STEPS: usize = 24, Derived "the median of 24 has a standard error of a quarter of their scatter";
        /// Least step that is looked at, as a share of the range and in noise, and the fall over two pixels that belongs to it.
        STEP: [f64; 3] = [0.2, 10.0, 0.4], Judged "a fifth of the range is a target's rim in `photos`";
        /// Scatter of a flat side, as a share of the step and in noise.
        FLAT: [f64; 2] = [0.1, 3.0], Derived "4 noise of the least step: four samples of noise have that range once in forty";
        /// Noise, as a share of the range, above which the thresholds of the search miss small targets.
        NOISY: f64 = 0.014, Judged "the threshold of the search is then a tenth of the range: what blur leaves of a small disc; without it, two thirds of the targets in noise of 20 are lost";
        /// Share of saturated samples from which the paper counts as saturated: only the foot of the profiles of its targets is visible.
        OVEREXPOSED: f64 = 0.4, Judged "paper that fills much of a photo; without it, 0.3 of the targets on paper exposed twice too long are lost";
        /// Excess of differences at the borders of blocks from which a picture counts as compressed.
        COMPRESSED: f64 = 0.12, Judged "uncompressed pictures have at most some hundredths by chance";
        /// Significance, in standard errors, of the difference between borders of blocks and their neighbours.
        CERTAIN: f64 = 4.0, Derived "chance: 3 in 100,000 pictures";
        /// Samples of a picture of two levels that differ from all four neighbours: their share of the changes along rows, and of all, from
        /// which they are the dots of a dithering.
        DOTTED: f64 = 0.15, Derived "thresholds at random make 0.25 of a middle grey, patterns and error diffusion more";
        DOTS: f64 = 0.005, Judged "specks of a scan are fewer, a grey disc of a hundredth of the picture has as many";
        /// Second differences that are enough where most of the picture is clipped.
        ENOUGH: u64 = 400, Derived "their quartile is good to 9 %";
        /// Maximum number of grey levels, and noise, of a drawing without soft edges.
        FEW: usize = 8, Judged "drawings and screenshots have few; if they are treated as photos, the error of their targets is 2.3 of the stated sigma";
        DRAWN: f64 = 0.5, Derived "rounding alone leaves 0.29";
        /// Saturation: minimum number of samples at the largest level, and their minimum ratio to those at the four levels below it.
        PILE: u32 = 20, Judged "fewer are not conclusive";
        PILED: u32 = 2, Judged "a histogram of noise and light does not do that at its end";
        /// Minimum step of an edge: in noise, as a share of the range, in grey levels.
        EDGE: [f64; 3] = [3.0, 0.015, 2.5], Derived "the fall between two bilinear samples has 0.94 of the noise: chance passes once in 1400 places";
        /// Minimum difference over three pixels that starts an edge of the search, in the same units.
        SEARCHED: [f64; 3] = [6.5, 0.03, 5.0], Derived "4.6 sigmas of a difference of two samples: chance passes four times in a million";
        /// The same in the quartered picture, whose noise is less than half.
        QUARTERED: [f64; 3] = [3.0, 0.03, 4.0], Derived "six sigmas: means of eight samples have 0.35 of the noise";
        /// Strong differences, as shares of the picture's range: an occluder with a level between those of target and paper has weaker edges
        /// than the target.
        STRONG: [f64; 2] = [0.45, 0.65], Measured "targets behind cables of `photos -- conditions`: of 1200, 1134 are found or reported as occluded instead of 1064; 0.15 to 0.75 tried";
        /// Minimum semi-minor axis of rims from which a sharpening is estimated.
        RIM: f64 = 5.0, Judged "smaller targets have no level inside: with all rims, one webcam grid of `photos` has one more false target";
        /// Amount of sharpening below which it is not undone.
        LITTLE: f64 = 0.3, Judged "the fit of a rendered ellipse takes half of that for a lens";
        /// Minimum share of the residual that a sharpening must explain.
        EXPLAINED: f64 = 0.3, Judged "random cameras of `photos` with and without a sharpening: without it errors of those grow, error over sigma from 0.98 to 1.02";
        /// Largest share of clipped samples at a distance from the rim.
        CLIPPED_RIM: f64 = 0.1, Judged "the mean of the others is then low by little";
        /// Amount from which on a fit is none of a sharpening.
        STRONGEST: f64 = 6.0, Judged "three times the strongest of `photos`; without it a camera's 1.66 is told as 11.6, and error over sigma of three webcam grids grows by up to an eighth";
        /// Sigma of the Gaussian mean with which a sharpened picture is smoothed for the search.
        SOFT: f64 = 1.6, Measured "the middle of the range in which the webcam pictures of dots in `photos` show all of them";
        /// The same after the sharpening is undone.
        RESTORED: f64 = 0.7, Judged "what is left of the picture's own blocks and ringing";
    }
}

/// How blurred a target is, and from where on that asks for something else.
pub(crate) mod blur {
    use super::Source;

    table! {
        /// What is assumed of a target before its blur is known, sigma in pixels.
        SHARP: f64 = 0.9, Judged "a lens in focus";
        /// Blur above which the annulus begins further out.
        BLURRED: f64 = 1.2, Judged "the foot of the edge then reaches into the first ring; with 1.3, centres of saturated targets of 10 px are a tenth worse";
        /// Blur above which a target's edges are refined before they are tested.
        SOFT: f64 = 1.3, Judged "the steepest place scatters by more than edges may differ";
        /// Blur above which its edges are searched between means of several samples.
        DEFOCUSED: f64 = 2.0, Judged "no place of an edge is the steepest within the noise";
    }
}

/// What a place is measured from, and which place is meant.
pub(crate) mod place {
    use super::Source;

    table! {
        /// Two measurements are of the same disc up to this distance, in the smaller semi-minor axis, and ratio of their semi-major axes.
        SAME: [f64; 2] = [0.25, 1.4], Judged "two discs that touch are two radii apart";
        /// Minimum and maximum standard deviation of the window of adaptive moments, in units of the picture's blur.
        NARROWEST: f64 = 0.7, Judged "a point spread function is no narrower, noise is";
        WIDEST: f64 = 5.0, Judged "a wider target has a rim and is measured by it";
        /// Minimum level above the background for a weight above 0, as a share of the contrast and in noise.
        WEIGHTED: [f64; 2] = [0.15, 3.0], Judged "noise of the background stays out";
        /// Minimum squared gradient for a weight above 0, in squares of the noise.
        STEEP: f64 = 9.0, Derived "noise alone has a mean of 1: chance passes once in 8000 pixels";
        /// Maximum distance of a click from the target that it selects.
        BESIDE: f64 = 4.0, Judged "a hand on the mouse";
    }
}

/// Blobs of the search.
pub(crate) mod blob {
    use super::Source;

    table! {
        /// Maximum relative deviation of a blob's area from that of its ellipse of moments, for more than three rows.
        FILL: f64 = 0.12, Derived "a triangle departs by 0.17, a bowl by more; a square, 0.05, goes by its ends";
        /// Area of an ellipse through the ends of the runs, in units of the area of the runs, above which the blob is a bar instead.
        UNSEEN: f64 = 2.5, Judged "bars of `detect`";
        /// Rms of ends from their ellipse: pixels, and share of its semi-minor axis.
        RMS: [f64; 2] = [0.3, 0.05], Judged "ends are good to a tenth of a pixel; letters and corners of `detect` leave more";
        /// Ratio of the wide parts of two touching targets to the neck between them.
        NECK: f32 = 1.5, Judged "touching discs of `detect`";
        /// Minimum ratio of the lengths of runs that belong together, and maximum distance of their ends: pixels, and share of the shorter.
        LINKED: f32 = 0.35, Judged "clutter and discs of `detect`";
        APART: [f32; 2] = [4.0, 0.25], Judged "as above";
        /// Maximum length of a spot in a run, and maximum distance of its middle from that of the run above, as shares of the run.
        SPOT: [f32; 2] = [0.3, 0.15], Judged "the spot of Metashape's dots, 0.09, grows by blur and sharpening: `prints`";
    }
}

/// Ellipses that most of a blob's border follows.
pub(crate) mod partial {
    use super::Source;

    table! {
        /// Share of the ends that one window has.
        WINDOW: f64 = 0.5, Judged "an occluder or a touching object on one side leaves more of the border in one piece";
        /// Least share of the ends that follows the ellipse.
        FOLLOWING: f64 = 0.55, Judged "a cover of a fifth of the diameter on one side hides all ends but these";
        /// Minimum share of an ellipse's width and of its height that the blob reaches over.
        SPANNED: f64 = 0.35, Derived "a cable of a fifth of the diameter across the middle leaves halves of 0.4, less room for their ends";
        /// Maximum distance of ends that follow an ellipse: pixels, and share of its semi-minor axis; and distance above which a window is
        /// given up, in the same units.
        GOOD: [f64; 2] = [0.3, 0.03], Judged "as the ends of a whole blob, less room for its shape";
        HOPELESS: f64 = 3.0, Judged "of windows with a piece of the cover one is nearer";
        /// Tolerance of ends in any case, pixels.
        STEPS: f64 = 0.15, Judged "rows are whole";
        /// Minimum minor axis, also of targets reported as occluded, and minimum number of runs: smaller blobs have too few ends.
        SMALLEST: f64 = 7.0, Judged "smaller ones have too few ends";
        RUNS: usize = 4, Derived "half of their ends are four, with the next ones enough for five unknowns";
    }
}

/// The first look at a blob: sixteen directions, two pixels each.
pub(crate) mod quick_test {
    use super::Source;

    table! {
        /// Distance of the outer pixel from the rim.
        OUTSIDE: f64 = 2.5, Judged "beyond the blur of a sharp photograph";
        /// Maximum number of directions without a step, for small blobs and for others.
        MISSING_SMALL: u32 = 3, Measured "none of 2600 targets in thirteen pictures is rejected, a quarter of the clutter of `detect` is";
        MISSING: u32 = 7, Derived "0.42 of the outline may be missing";
        /// Minor axis of small blobs in units of the smallest that may have a gap.
        SMALL: f64 = 0.8, Judged "the search knows sizes to a fifth";
        /// Maximum number of directions in which the shape is open: at first, when the outline is known, and then with a small gap.
        OPEN: u32 = 5, Judged "bowls and joined strokes of `detect`";
        OPEN_MEASURED: u32 = 3, Judged "as above, with the outline through edges";
        MISSING_WHOLE: u32 = 2, Derived "a tenth of sixteen directions";
        /// Directions in which step and inside may fail where a sector is occluded.
        OCCLUDED: u32 = 8, Judged "covers of a fifth of the diameter, `photos -- conditions`";
        /// Mean step of the better twelve directions, in noise.
        FAINT: f64 = 3.3, Derived "eight sigmas of a mean of twelve differences, of which the choice of the better ones takes some";
        /// Step from which noise makes no holes in it, and places in which it may then be missing.
        CLEAR: f64 = 6.0, Derived "of such a step noise leaves less than 0.4 once in 190 directions";
        GAPS: u32 = 2, Derived "a cable runs across a target's outline twice";
        /// Minimum step, as a share of the typical step.
        STEP: f32 = 0.4, Judged "light, blur and noise change a step by less";
        /// Maximum difference from the level of the inside, as a share of the typical step, in an open direction.
        OWN: f32 = 0.3, Judged "less than the least step";
        /// Maximum number of directions in which the inside may be darker, and of those in which it may be brighter.
        STRANGE: usize = 2, Judged "a spot in front of it, or a shadow, on either side of the middle";
        /// Spread of the inside, as a share of the typical step.
        EVEN: f32 = 0.8, Judged "a spot or a shadow takes less";
        /// Maximum difference from the level of the inside, as a share of the contrast, at which that level occurs again outside.
        COMES_BACK: f64 = 0.5, Derived "half-way";
    }
}

/// Edges and the ellipse through them.
pub(crate) mod outline {
    use super::Source;

    table! {
        /// Tolerance of an edge point in any case, pixels, and in robust standard deviations.
        TOLERANCE: f64 = 0.25, Judged "blur, printing and pixels move edges by that without noise";
        SIGMAS: f64 = 3.0, Derived "of 48 rays chance takes one in every eighth outline";
        /// Blur s moves the steepest place of a rim of curvature κ inwards by about κ s² / 2. Allowance for s² / 2 at the tips of a slender
        /// ellipse, square pixels.
        BENT: f64 = 0.4, Derived "half the square of a blur of 0.9 px";
        /// Maximum share of the outline missing in one piece without further tests, also of that missing outside an occluded sector; the total
        /// missing share times the second value counts as one piece.
        SMALL_GAP: f64 = 0.1, Judged "counters and bowls of `detect` have more";
        SCATTERED: f64 = 0.6, Judged "as above";
        /// Maximum share of an occluded target's outline that may be missing.
        HIDDEN: f64 = 0.42, Judged "most of the outline is seen";
        /// Minor axis below which the quick test allows no gap, and what is occluded is rejected with that reason; factor of the allowed gap of a first outline.
        GAP_MINOR: f64 = 12.0, Judged "the letters of `detect` that have an ellipse with a gap are smaller";
        GAP_FIRST: f64 = 2.0, Judged "few rays, the second round decides";
        /// Scatter of the steepest place of an edge of contrast C by noise n, in units of n / C, at least.
        SPREAD: f64 = 2.8, Judged "1.7 for a sharp edge, and room for other profiles";
        /// The same for a blur: times its cube, at most times itself; for a fitted profile: times its square root.
        SPREAD_CUBE: f64 = 1.2, Derived "sqrt(6) n over twice the second derivative of the fall, 0.8 C / s³, samples drawn from four pixels";
        SPREAD_WIDE: f64 = 4.0, Derived "the fall between means of s samples";
        SPREAD_FITTED: f64 = 1.9, Derived "sqrt(2 sqrt(π))";
        /// Deviation of the edges from a good outline without noise, as a share of its semi-minor axis.
        SHAPE: f64 = 0.02, Judged "printing, compression and the picture's grid add up to 1 % of the diameter";
        /// Maximum scatter of the edges over the expected one; the same for a first outline, and the minimum expected scatter of that, pixels.
        SCATTER: f64 = 1.1, Judged "the expected scatter has a margin already";
        SCATTER_FIRST: f64 = 1.3, Judged "as above, before the blur is known";
        SCATTER_FLOOR: f64 = 0.05, Judged "a first fit has made one correction";
        /// Addition to the scatter of a first outline of a small target, pixels, and maximum semi-minor axis of small targets.
        SCATTER_SMALL: f64 = 0.2, Measured "0.36 px in one of 2500 isolated circles of 5 px";
        SMALL: f64 = 5.0, Judged "the search knows the height of so few rows to two pixels only";
        /// Maximum rms distance of edges from an outline: pixels, and share of its semi-minor axis.
        RMS: [f64; 2] = [0.3, 0.03], Judged "above it no expected scatter justifies the outline";
        /// Number of consecutive rays without a fitting edge where something lies on the rim.
        DISTURBED: usize = 3, Judged "one edge out of place is chance, two in a row are seldom; without it, errors of discs with glare on the rim are 1.5 sigma";
        /// Maximum change of an outline with which its edges are not searched again.
        HEAD_ON: f64 = 0.4, Judged "rays still meet the rim nearly at right angles";
    }
}

/// Grey levels in and around an outline.
pub(crate) mod levels {
    use super::Source;

    table! {
        /// Minimum contrast of a target in units of the noise around it; that noise is limited to a multiple of the picture's plus grey levels.
        CONTRAST: f64 = 4.0, Judged "fainter discs have no outline";
        DISTURBED: [f64; 2] = [4.0, 2.0], Judged "more is texture and no noise";
        /// Contrast in noise times minor axis in pixels, below which a target has too few pixels to differ from the counter of a letter.
        SHAPELY: f64 = 100.0, Judged "letters of `detect`";
        /// Contrast, in noise, below which noise hides the difference between the counter or the bowl of a letter and an ellipse with or without
        /// a gap.
        FAINT: f64 = 25.0, Judged "as above; edges are then good to a tenth of a pixel";
        /// Maximum number of the sixteen directions in which a faint target may be surrounded by a thin ring.
        STROKE: u32 = 11, Judged "the ring of a code surrounds it in fewer, the stroke of a letter in nearly all";
        /// Maximum share of the inside that differs from the rest by more than a third of the contrast.
        UNEVEN: f64 = 0.25, Judged "a target with more is reported as occluded; with 0.2 of the inside, one in fourteen of the targets behind cables of `photos -- conditions` is lost";
        /// Maximum noise estimated in an annulus, in units of the picture's noise; minimum noise of any picture, in units of the distance between two levels.
        BELIEVED: f64 = 1.1, Judged "if the annulus is not plane, the noise of the whole picture is used";
        ROUNDING: f64 = 0.3, Derived "rounding leaves 0.29";
        /// Minimum number of rays of a ring of the annulus, in tenths of all rays.
        RING_TENTHS: f64 = 6.0, Judged "the plane needs more than one side of the target";
        /// Minimum noise with which a ring of the annulus or a pixel of the fit is tested.
        QUIET: f64 = 0.5, Derived "rounding leaves 0.29, and a plane is no background to a fraction of a level";
        /// Maximum rms and mean, in that noise, of a ring that belongs to the plane.
        RING: [f64; 2] = [1.7, 0.9], Judged "the foot of a neighbour's edge shows in the mean first";
    }
}

/// Light that changes across a target.
pub(crate) mod light {
    use super::Source;

    table! {
        /// Standard deviation of the change of light from pixel to pixel, as a share of the light.
        STEEPEST: f64 = 0.02, Judged "a tenth across a target of 5 px: more is a shadow's edge";
        /// Minimum semi-minor axis in pixels, and redundancy, of the part of a disc that shows the light inside.
        CORE: [f64; 2] = [1.5, 6.0], Judged "fewer pixels determine it less well than the background";
        /// Minimum variance of a slope, (grey levels per pixel)².
        FLOOR: f64 = 1e-8, Judged "a thousandth of a level across a target: drawings without noise have no variance";
    }
}

/// The fit of a rendered ellipse.
pub(crate) mod fit {
    use super::Source;

    table! {
        /// Minimum rise of the level beside a target that indicates a neighbouring object: share of the contrast, and rms of the fit.
        RISE: [f64; 2] = [0.1, 5.0], Derived "the range of six bilinear samples of noise exceeds five deviations on one of 48 rays of every hundredth target";
        /// Residual above which a pixel does not belong to the target: in noise, and share of the contrast for a lens and for a drawing.
        OUTLIER: f64 = 5.0, Derived "chance exceeds it in none of a thousand pixels";
        LENS: f64 = 0.06, Judged "a lens does that all around";
        STAIRS: f64 = 0.7, Judged "a pixel of stairs is wrong by up to a half";
        /// The same of an edge sharper than any that is rendered.
        SHARP: f64 = 0.1, Derived "it leaves up to 0.4 of the least blur, 0.2 px, in a pixel; without it one in 300 of the screenshot of `photos -- conditions` is lost";
        /// Deviation of a rim from its ellipse that may be its true shape, in units of the rms of the edges.
        DEPARTS: f64 = 3.0, Derived "a wave departs by 1.4 of its rms, and noise of an edge seldom by 3; without it discs out of round by 0.5 % of 60 px are reported as occluded at low noise";
        /// The same for pixels off the rim: in noise, minimum noise, share of the contrast inside.
        FLAT: [f64; 3] = [4.0, 0.6, 0.05], Derived "chance exceeds it in 6 of 100,000 flat pixels";
        /// Maximum share of the rim's pixels that may be excluded.
        DISTURBED: f64 = 0.12, Judged "a small gap and a neighbour";
        /// Maximum rms of the residuals, also of a fit in the sensor's samples: in noise, and share of the contrast in photos and in drawings.
        RMS_NOISE: f64 = 1.5, Judged "noise that grows with the light";
        RMS_PROFILE: f64 = 0.1, Judged "a lens over the whole band";
        RMS_STAIRS: f64 = 0.25, Judged "the same for stairs";
        /// Maximum residual that noise does not explain and that varies around the rim, as a share of the contrast: for a minor axis of 10 px,
        /// its increase per pixel, and at most, which is also that of drawings.
        MISFIT: [f64; 3] = [0.045, 0.006, 0.12], Judged "letters against discs of `detect`; large targets show what print and lens do";
        MISFIT_MINOR: f64 = 10.0, Judged "as above";
        /// Contrast, in noise, below which this limit is reduced in proportion.
        MISFIT_FAINT: f64 = 40.0, Judged "on faint targets noise hides both; without the reduction, the pictures without targets of `photos` have one false target";
        /// The same of a drawing.
        MISFIT_STAIRS: f64 = 0.2, Judged "drawn discs; with 0.12 one in 200 of the binary drawing of `photos -- conditions` is lost";
        /// Maximum sum of the squares of scatter and misfit, each over its limit.
        TOGETHER: f64 = 1.15, Judged "each limit is for one of them alone; without it, the pictures without targets of `photos` have eight false ones";
        /// Maximum missing share of an outline that counts as complete; minimum gap before a ring, in pixels, for a narrower annulus.
        WHOLE: f64 = 0.05, Judged "two of 48 rays";
        NARROW: f64 = 1.0, Judged "one pixel of background";
        /// Minimum number of pixels for the ten unknowns.
        PIXELS: usize = 24, Derived "14 of redundancy";
        /// Contrast of saturated targets, also in the sensor's samples, over the range of the picture: maximum; that from which nothing of the rim
        /// is left; and the minimum then.
        OVEREXPOSED: f64 = 16.0, Judged "the centre hardly depends on it: the image of an ellipse is symmetric about it";
        STEP_LEFT: f64 = 0.97, Judged "at the largest contrast the rim is a step, whose sigma would be too small";
        STEP_LEAST: f64 = 2.0, Judged "half of the profile shows";
        /// Level, as a share of the scale, above which a bright target counts as saturated; share of saturated pixels that explains a failed
        /// fit.
        CLIPPED: f64 = 0.9, Judged "contrast and blur become strongly correlated";
        MOSTLY_CLIPPED: f64 = 0.5, Judged "half of its pixels";
        /// Observed value and standard deviation of the blur of a lens in focus; standard deviation of an unknown contrast, in units of its
        /// visible part. Neither is correlated with the centre.
        IN_FOCUS: [f64; 2] = [0.8, 0.25], Judged "lenses in focus, with the pixel";
        LOOSE: f64 = 100.0, Derived "no information";
        /// Variance of the residuals over that of the noise, above which they are examined further; correlation of neighbours above which they
        /// are not noise (but light, for example); and number of pixels whose residuals then count as one.
        UNEXPLAINED: f64 = 1.7, Judged "beyond the noise of light";
        /// Variance of the residuals over that of the noise, above which the rim may differ from an ellipse.
        SHAPED: f64 = 1.1, Derived "a smaller deviation moves a centre by less than its sigma; the search costs a tenth of the time";
        SHARED: f64 = 0.15, Judged "noise of single pixels has less";
        MOVED_TOGETHER: f64 = 3.0, Measured "error over sigma of cameras moved by 2 to 6 px, `photos -- conditions`";
    }
}

/// Partly occluded targets.
pub(crate) mod occlusion {
    use super::Source;

    table! {
        /// Sectors tried: shares of the outline.
        SECTORS: [f64; 3] = [0.15, 0.25, 0.35], Derived "a cover of a fifth of the diameter takes 0.295 of a circle's";
        /// Scatter of edges below which all sectors are equivalent.
        EVEN: f64 = 0.02, Judged "with less, sectors cannot be distinguished";
        /// Standard error, in pixels, that is added to that of an occluded target's centre.
        PULLED: f64 = 0.15, Measured "rms of the centres behind covers and cables of `photos -- conditions`: 0.10 and 0.14";
        /// Scatter, relative to what is expected of a good outline, of one that is shown as hidden.
        CLEAR: f64 = 0.7, Judged "no false target in conditions, pictures without targets and `detect`";
    }
}

/// Donuts.
pub(crate) mod rims {
    use super::Source;

    table! {
        /// Maximum distance from a hole's centre, in its semi-major axes, at which the outer rim is searched.
        FARTHEST: f64 = 12.0, Judged "the spot in the centre of Metashape's dots is an eleventh; without a limit the search around every dot would extend to the border of the picture";
        /// Minimum step at the outer rim, as a share of the hole's contrast and in noise.
        RETURNS: f64 = 0.4, Judged "the background may be closer to the level of the donut than its hole is; as the minimum step of the quick test";
        CLEAR: f64 = 6.0, Derived "chance passes nowhere on 48 rays of a hundred places";
        /// Share of the rays on which it does, and how far these places may be from their median radius.
        SEEN: f64 = 0.8, Judged "a gap of a tenth, and a neighbour";
        ROUGH: f64 = 0.3, Judged "a hole off centre by a tenth changes it by less";
        /// Maximum distance of the two centres, in the outer semi-minor axis, of the rims of one donut.
        CONCENTRIC: f64 = 0.15, Judged "more is a disc with a mark on it";
        /// Squared distance of the centres, in their standard errors, above which they differ significantly.
        OFF: f64 = 13.8, Derived "99.9 % of χ² of two degrees of freedom";
    }
}

/// Targets of a photo by what the others have in common.
pub(crate) mod small_targets {
    use super::Source;

    table! {
        /// Minimum number of known targets, and their minimum minor axis in blurs.
        ENOUGH: usize = 6, Judged "fewer give no spread";
        PLAIN_MINOR: f64 = 5.0, Derived "the middle of such a disc shows 0.96 of its contrast";
        /// Blur, in pixels, above which small discs are also searched for in a picture that is neither sharpened nor compressed.
        SWALLOWING: f64 = 1.3, Derived "a disc of 5 px then shows less than 0.85 of its contrast, and no flat part";
        /// Rms of the residuals of a picture's targets, in noise of its flat background: above which residuals of neighbours may be
        /// correlated, and above which they make the search miss targets.
        NOISY_RIMS: [f64; 2] = [1.3, 2.0], Judged "in-camera denoising leaves noise at edges: without the first, errors are 2.5 sigmas; without the second, `edge_noise.png` of the cases loses 22 of 35 dots";
        /// Maximum ratio of the contrasts of a photo's targets.
        CONTRASTS: f64 = 2.5, Judged "light falls off, and so does what blur leaves of the smallest; 40 random cameras of `photos`";
        /// Minimum standard deviations of blur and of contrast among targets, as shares.
        BLURS: f64 = 0.06, Judged "as above";
        SHADES: f64 = 0.15, Judged "as above";
        /// Maximum residuals, in units of those of the known targets, and addition to them as a share of the contrast.
        AS_GOOD: f64 = 1.5, Judged "as above";
        PROFILE: f64 = 0.04, Judged "as above";
        /// Residuals that the first correction of a fit promises, in units of that maximum at the contrast that it promises, above which the fit
        /// is given up.
        HOPELESS: f64 = 3.0, Measured "of 879 targets found so in a hundred pictures of `photos` none had a prediction above 2.7";
        /// Minimum share of the expected contrast at a position for a fit.
        LIGHT: f64 = 0.5, Judged "the level of the background is uncertain";
        /// Share of its contrast, exceeded in a quarter and in an eighth of the directions around a disc, above which it touches another object.
        JOINED: [f64; 2] = [0.6, 0.9], Measured "of 1925 targets found so in `photos 100` and `conditions` at most 0.52 and 0.76; of 2400 other shapes of det1.camera.jpg seven in ten have more";
        /// Minimum semi-minor axis, in blurs, of a disc whose background is only the gap before a ring; and distance of the end of that gap
        /// from the ring, in blurs.
        GAP: f64 = 3.0, Measured "error over sigma of 1000 small coded dots of sharpened and compressed photos: 1.0 to 1.5 above, 2.7 and more below";
        RING_APART: f64 = 1.2, Derived "blur leaves there an eighth of the ring's contrast, and less further in";
        /// Maximum semi-minor axis, in blurs, of discs that are searched for only inside a ring.
        LARGEST: f64 = 8.0, Measured "of 1700 small coded dots found so all but a handful, whose rings are not read as codes, are smaller";
        /// Maximum share of the contrast that the gap may lack in some direction.
        GAP_LACKS: f64 = 0.5, Derived "half-way";
        /// Largest share of pixels that neighbours may disturb.
        DISTURBED: f64 = 0.25, Judged "neighbours at a pitch of 2.5 radii, `photos -- conditions`; 0.45 shows a false target more in two of the webcam grids";
        /// Maximum distance of the fitted centre from that of the blob: pixels, and share of the semi-minor axis; during the iterations twice
        /// that.
        MOVED: [f64; 2] = [1.0, 0.3], Judged "40 random cameras of `photos`";
        /// Targets found in a smoothed picture must not be fainter than the 1/n quantile of the known contrasts over [`CONTRASTS`].
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
        /// Maximum share of sites that may be excluded.
        DISTURBED: f64 = 0.3, Judged "neighbours and dirt count here, beyond the rim too";
        /// Minimum distance below the white level of a site that is used, in standard deviations of the noise.
        WHITE: f64 = 3.0, Derived "of 700 such sites noise clips one";
        /// A hot site is brighter than all its neighbours by so many standard deviations of the noise, and so many times as bright.
        HOT: f64 = 8.0, Derived "chance: none of 10^14 sites";
        HOT_TIMES: f64 = 2.0, Judged "no light does that from one site to the next";
        /// Maximum relative standard error of the read-out variance with which it is reported.
        TOLD: f64 = 0.5, Derived "its root is then good to a quarter";
    }
}

/// Colours apart.
pub(crate) mod colours {
    use super::Source;

    table! {
        /// Minimum number of targets that show a lateral chromatic aberration of four unknowns.
        FEWEST: usize = 6, Judged "twelve equations for four unknowns";
        /// Residual in standard errors above which a target is not used.
        FAR: f64 = 4.0, Derived "chance: 6 in 100,000";
        /// Difference in pixels above which two measurements are of different targets.
        BEYOND: f64 = 6.0, Judged "lenses leave up to three pixels in a corner";
        /// Standard errors beyond which a shift is significant.
        SIGNIFICANT: f64 = 3.0, Derived "chance: 3 in 1,000";
        /// Pixels below which a shift needs no attention, significant or not.
        NEGLIGIBLE_PX: f64 = 0.02, Judged "standard errors of good targets";
    }
}
