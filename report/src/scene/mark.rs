//! Marks of a panel.

use serde::Serialize;

use super::Colour;

/// Shapes of one colour at positions `P`, with two coordinates in a plane or three in space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark<P> {
    /// Name in the legend; empty for marks without an entry.
    pub name: String,
    /// Colour.
    pub colour: Colour,
    /// Opacity, from 0 (invisible) to 1.
    pub opacity: f64,
    /// Shapes.
    #[serde(flatten)]
    pub shape: Shape<P>,
}

/// Shapes of a mark.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "shape", rename_all = "lowercase")]
pub enum Shape<P> {
    /// Polylines.
    Lines {
        /// Points of each line.
        lines: Vec<Vec<P>>,
        /// Line width in pixels.
        width: f64,
        /// True for limits and published figures, which are dashed.
        dashed: bool,
    },
    /// Dots.
    Points {
        /// Their positions.
        points: Vec<P>,
        /// Radius in pixels.
        radius: f64,
    },
    /// Crosses.
    Crosses {
        /// Their positions.
        points: Vec<P>,
    },
    /// Area between two lines.
    Band {
        /// Lower line.
        lower: Vec<P>,
        /// Upper line.
        upper: Vec<P>,
    },
    /// Rectangles parallel to the axes.
    Bars {
        /// Two opposite corners of each.
        bars: Vec<[P; 2]>,
    },
    /// Grid of patches, coloured by their values.
    Surface {
        /// Corners of the patches, row by row from back to front; none where there is no value.
        corners: Vec<Vec<Option<Corner<P>>>>,
        /// Values of the darkest and of the lightest colour.
        range: [f64; 2],
    },
    /// Labels.
    Texts {
        /// Position and text of each; the text is to the upper right.
        texts: Vec<(P, String)>,
    },
}

/// Corner of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Corner<P> {
    /// Position.
    pub at: P,
    /// Value shown by the colour.
    pub value: f64,
}

impl<P: Copy> Mark<P> {
    /// Creates marks without a name.
    pub(crate) fn new(colour: Colour, shape: Shape<P>) -> Self {
        Self { name: String::new(), colour, opacity: 1.0, shape }
    }

    /// Creates one line.
    pub(crate) fn line(colour: Colour, width: f64, points: Vec<P>) -> Self {
        Self::lines(colour, width, vec![points])
    }

    /// Creates several lines.
    pub(crate) fn lines(colour: Colour, width: f64, lines: Vec<Vec<P>>) -> Self {
        Self::new(colour, Shape::Lines { lines, width, dashed: false })
    }

    /// Creates several dashed lines.
    pub(crate) fn dashed(colour: Colour, lines: Vec<Vec<P>>) -> Self {
        Self::new(colour, Shape::Lines { lines, width: 1.3, dashed: true })
    }

    /// Creates dots.
    pub(crate) fn points(colour: Colour, radius: f64, points: Vec<P>) -> Self {
        Self::new(colour, Shape::Points { points, radius })
    }

    /// Creates rectangles.
    pub(crate) fn bars(colour: Colour, bars: Vec<[P; 2]>) -> Self {
        Self::new(colour, Shape::Bars { bars })
    }

    /// Creates a surface.
    pub(crate) fn surface(corners: Vec<Vec<Option<Corner<P>>>>, range: [f64; 2]) -> Self {
        Self::new(Colour::INK, Shape::Surface { corners, range })
    }

    /// Sets the name.
    pub(crate) fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Sets the opacity.
    pub(crate) fn faded(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// Returns the positions of all shapes.
    pub(crate) fn places(&self) -> Vec<P> {
        match &self.shape {
            Shape::Lines { lines, .. } => lines.iter().flatten().copied().collect(),
            Shape::Points { points, .. } | Shape::Crosses { points } => points.clone(),
            Shape::Band { lower, upper } => lower.iter().chain(upper).copied().collect(),
            Shape::Bars { bars } => bars.iter().flatten().copied().collect(),
            Shape::Surface { corners, .. } => {
                corners.iter().flatten().flatten().map(|corner| corner.at).collect()
            }
            Shape::Texts { texts } => texts.iter().map(|(at, _)| *at).collect(),
        }
    }

    /// Transforms all positions.
    pub(crate) fn map<Q>(&self, place: impl Fn(P) -> Q) -> Mark<Q> {
        let all = |points: &[P]| points.iter().map(|point| place(*point)).collect::<Vec<_>>();
        let shape = match &self.shape {
            Shape::Lines { lines, width, dashed } => {
                let lines = lines.iter().map(|line| all(line)).collect();
                Shape::Lines { lines, width: *width, dashed: *dashed }
            }
            Shape::Points { points, radius } => Shape::Points { points: all(points), radius: *radius },
            Shape::Crosses { points } => Shape::Crosses { points: all(points) },
            Shape::Band { lower, upper } => Shape::Band { lower: all(lower), upper: all(upper) },
            Shape::Bars { bars } => Shape::Bars { bars: bars.iter().map(|bar| bar.map(&place)).collect() },
            Shape::Surface { corners, range } => {
                let corner = |corner: &Option<Corner<P>>| {
                    corner.map(|Corner { at, value }| Corner { at: place(at), value })
                };
                let corners = corners.iter().map(|line| line.iter().map(corner).collect()).collect();
                Shape::Surface { corners, range: *range }
            }
            Shape::Texts { texts } => {
                Shape::Texts { texts: texts.iter().map(|(at, text)| (place(*at), text.clone())).collect() }
            }
        };
        Mark { name: self.name.clone(), colour: self.colour, opacity: self.opacity, shape }
    }
}
