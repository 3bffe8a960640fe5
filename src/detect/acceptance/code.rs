//! Thresholds of ring codes; levels are fractions of the dot's contrast.

use super::Source;

table! {
    /// Misfit, over what a code may have, from which a coarse phase is not refined.
    HOPELESS: f64 = 2.0, Judged "refining gains less";
    /// Smallest margin of a sector that is safe, and how many of its standard errors it must be.
    SAFE: f64 = 0.45, Measured "of codes as in `codes` one in 200 has less than 0.46 (0.50 under a curve); wrong readings of small dots had 0.40 to 0.44";
    SIGMAS: f64 = 4.5, Derived "chance: 3 in a million sectors";
    /// Levels of set and unset sectors.
    HIGH: std::ops::Range<f64> = 0.6..1.5, Judged "print, light and blur of thin rings in `codes`";
    LOW: f64 = 0.25, Judged "as above";
    /// Share of the least level of set sectors that some direction of a ring shows, whatever blur leaves.
    FAINT: f64 = 0.4, Derived "a lone sector shows as much of its level where it is 1.05 blurs wide";
    /// Maximum change of the level of set sectors by the light, as a share of the step between the levels.
    UNEVEN: f64 = 0.35, Judged "light that changes by a ninth from one radius to the next, at the ring's three";
    /// Maximum deviation from the background in the gap and outside of a set sector, and maximum difference of the halves of a sector.
    CLEAR: f64 = 0.38, Judged "as a sector's margin";
    HALVES: f64 = 0.45, Judged "covers and neighbours of `codes`";
    /// The same on the mean over the set sectors: what a ring of another size leaves there.
    MEAN_CLEAR: f64 = 0.27, Judged "concentric rings and codes of the other design in `codes`";
    MEAN_HALVES: f64 = 0.3, Judged "as above";
    /// The same before the ring is divided into sectors, in the directions where it is set.
    BESIDE: f64 = 0.54, Measured "of 3000 rings that `codes` reads or leaves in doubt at most 0.31; 98 in 100 of the targets of det1.png beside something have more";
    /// Maximum deviation of an unset sector that has the same sign as that of its gap or its background, as a share of the step: sharp, and times the
    /// blur over a sector's width more.
    VEIL: [f64; 2] = [0.1, 0.4], Measured "of 1300 codes as in `codes` q99 is 0.04 of sharp ones and 0.14 where blur is 0.3 sectors; a grey cover that changed a number had 0.17";
    /// How far a sector may be from the level it has; further only by chance.
    OFF: f64 = 0.3, Judged "covers in front of rings of `codes`";
    /// Largest rms of what the sectors leave unexplained, over their contrast.
    MISFIT: f64 = 0.2, Judged "neighbours and covers of `codes`";
    /// Ratio of the squares of two divisions' misfits from which the other one is the right one, and from which it may be.
    BETTER: f64 = 1.6, Judged "families against each other in `codes`";
    AS_GOOD: f64 = 0.9, Measured "of codes as in `codes` with dots from 12 px one in 700 is above; wrong readings had 0.91 to 0.99";
    /// The same ratio of a division's misfit and that of discs where its set sectors are.
    DISCS: [f64; 2] = [0.85, 0.7], Measured "of 300 codes as in `codes` of a mean radius from 6 px the largest is 0.72, q99 0.54, of smaller ones q98 0.83; of 46 rings of discs of that size that passed all else the least is 0.89; discs cut off at the rays of their sectors may have less";
    /// The ratio where sectors are narrower than so many pixels, and show little of their shape.
    DISCS_SMALL: f64 = 1.0, Derived "discs have to leave less than sectors";
    SHAPED: f64 = 4.5, Measured "of 600 readings of photographed prints the largest ratios are 0.94 at sectors of 3.4 px and 0.97 at 4.2 px; all others are below 0.65";
    /// Maximum number of doubtful sectors, and minimum number of certain set sectors.
    DOUBTFUL: usize = 3, Judged "up to eight candidates are a question, more are none";
    SURE: usize = 2, Judged "a ring shows in sectors that are beyond doubt";
    /// Distance of an arc's end from the grid, one end's and the rms of all: sectors, and pixels besides.
    ENDS: [f64; 2] = [0.05, 0.5], Measured "of codes as in `codes` q99.7 is 0.54 px in sectors of 3 to 5 px, 0.52 px in those of 12 to 20";
    ENDS_RMS: [f64; 2] = [0.04, 0.28], Measured "of the same codes q99.7 is 0.37 px in sectors of 3 to 4 px, 0.30 px in those of 5 to 8";
    /// What sectors of free levels leave of a direction: of their contrast, and of what the bands of a ray leave where noise is more.
    LEFT: [f64; 2] = [0.075, 2.5], Measured "of the same codes q99.7 is 0.067; rings of other sectors that passed all else had 0.08 to 0.14, 3.3 to 8";
    /// Distance of the ring's rims from those of the design: radii of the dot, and pixels besides.
    RIMS: [f64; 2] = [0.08, 0.5], Measured "of the same codes at most 0.13 radii of 4 px, 0.04 of 16 px";
    /// Misfit of gap, ring and outside together, of which the share counts below.
    WHOLE: f64 = 0.15, Measured "of the same codes q99.7 is 0.143";
    /// Largest root of the sum of squares of the shares that a ring has of its limits: of a dot of no size, for each pixel of its radius
    /// more, and at most.
    JOINT: [f64; 3] = [0.6, 0.1, 1.15], Measured "of thirteen wrong readings in 100,000 pictures all but one are above, and the one of 38,000 after them; of 2531 true ones of dots from 12 px five";
    /// The same of a ring that is one arc.
    SINGLE: f64 = 1.0, Measured "three broken rings of 130,000 pictures that were read as codes had 1.3 and more as they were found, one of them less at its true place; of true codes one in 130 is a single arc, of these three in ten are above";
    /// Share of directions in which something else of the dot's colour stands around a ring of one arc.
    RINGED: f64 = 0.3, Measured "of three wrong ones among concentric rings 0.4 and more; of 22 true ones with neighbours two are above";
    /// Codes of a photo that are beyond doubt from which an uncertain one is taken for one too.
    COMPANY: usize = 4, Judged "what the photo shows are codes then";
    /// Blur of a dot's rim over its radius from which that is not known well enough: another tone curve makes it another, and with it the
    /// ring that of the other design.
    BLURRED: f64 = 0.38, Measured "of the same codes one in 500 of dots below 12 px, none above; two of thirteen wrong readings";
    /// Largest difference between the grounds beside set and beside unset sectors.
    GROUNDS: f64 = 0.12, Measured "of the same codes at most 0.05; a ring wider by 0.6 radii 0.31";
    /// Distance of two ends of arcs, in sectors, up to which they are the same.
    SAME: f64 = 0.05, Judged "no picture tells them apart";
    /// Level of something of the dot's colour in a first look, and how many in twenty directions.
    SET: f64 = 0.35, Judged "set sectors of thin rings under blur";
    LOOKED: usize = 20, Judged "half of two sectors of twenty: what blur leaves";
    /// Minimum difference of the two levels, and minimum contrast in grey levels.
    STANDS_OUT: f64 = 0.1, Judged "below nothing is a ring";
    CONTRAST: f64 = 1.0, Derived "one grey level";
    /// Distance of a direction's background from the plane through all, as a share of the contrast, round by round.
    GROUND: [f64; 4] = [0.5, 0.3, 0.2, 0.2], Judged "grounds of `codes`";
    /// How far beyond the ring a part of it may reach, in radii.
    BEYOND: f64 = 0.25, Judged "half a ring of the narrower design";
    /// Ellipses in the middle of a ring that make one of it; the ratio of their contrast and the dot's; the distance of their centres from the
    /// middle, in widths of the ring and for pixels by which the dot's rim is off; their extent along the ray, in widths of the ring.
    SECTORS: usize = 2, Judged "one may be any neighbour: a click away from a dot stands another";
    SECTOR_CONTRAST: f64 = 0.5, Judged "blur and a tone curve leave half of a thin sector's contrast";
    SECTOR_MIDDLE: [f64; 2] = [0.2, 0.6], Measured "sectors found in developed photos lie within 0.1 of the middle; a tone curve moves the rim of a dot of 6 px by up to 0.6 px";
    SECTOR_WIDTH: std::ops::Range<f64> = 0.8..1.2, Measured "sectors found in developed photos have 0.85 to 1.15";
    /// Largest area of such an ellipse, in that of the dot.
    SECTOR_AREA: f64 = 0.65, Judged "neighbours of one size and of axis ratios from 0.7 have more, where they nearly touch they stand as far as a ring";
    /// Largest size of the spot in the centre of a code's dot, in radii of the dot.
    SPOT: f64 = 0.16, Judged "0.09 by its maker, and what blur adds";
    /// Power of the level that is light again, and the least axis of a dot in pixels from which that makes no difference.
    TONE: f64 = 2.2, Judged "the curve of sRGB, which cameras follow about";
    TONE_SMALL: f64 = 40.0, Derived "half a pixel is less than a twentieth of a sector of 20";
}
