//! What is drawn in a panel.

use serde::Serialize;

use super::Colour;

/// Shapes of one colour, at places `P`: two coordinates in a plane, three in space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark<P> {
    /// What it shows; a legend tells named marks apart.
    pub name: String,
    /// The colour.
    pub colour: Colour,
    /// From 0, invisible, to 1.
    pub opacity: f64,
    /// The shapes.
    #[serde(flatten)]
    pub shape: Shape<P>,
}

/// The shapes of a mark.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "shape", rename_all = "lowercase")]
pub enum Shape<P> {
    /// Lines through points.
    Lines {
        /// The points of each line.
        lines: Vec<Vec<P>>,
        /// In pixels.
        width: f64,
        /// Dashed lines are limits and what is published.
        dashed: bool,
    },
    /// Dots.
    Points {
        /// Their places.
        points: Vec<P>,
        /// In pixels.
        radius: f64,
    },
    /// Crosses.
    Crosses {
        /// Their places.
        points: Vec<P>,
    },
    /// The area between two lines.
    Band {
        /// The lower line.
        lower: Vec<P>,
        /// The upper line.
        upper: Vec<P>,
    },
    /// Rectangles along the axes.
    Bars {
        /// Two opposite corners of each.
        bars: Vec<[P; 2]>,
    },
    /// A grid of patches, coloured by their values.
    Surface {
        /// The corners of the patches, line by line, those in the back first; none where nothing is known.
        corners: Vec<Vec<Option<Corner<P>>>>,
        /// The values of the darkest and of the lightest colour.
        range: [f64; 2],
    },
    /// Words.
    Texts {
        /// Each right above its place.
        texts: Vec<(P, String)>,
    },
}

/// A corner of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Corner<P> {
    /// Its place.
    pub at: P,
    /// What its colour shows.
    pub value: f64,
}

impl<P: Copy> Mark<P> {
    fn new(colour: Colour, shape: Shape<P>) -> Self {
        Self { name: String::new(), colour, opacity: 1.0, shape }
    }

    /// One line.
    pub(crate) fn line(colour: Colour, width: f64, points: Vec<P>) -> Self {
        Self::lines(colour, width, vec![points])
    }

    /// Several lines.
    pub(crate) fn lines(colour: Colour, width: f64, lines: Vec<Vec<P>>) -> Self {
        Self::new(colour, Shape::Lines { lines, width, dashed: false })
    }

    /// Several dashed lines.
    pub(crate) fn dashed(colour: Colour, lines: Vec<Vec<P>>) -> Self {
        Self::new(colour, Shape::Lines { lines, width: 1.3, dashed: true })
    }

    /// Dots.
    pub(crate) fn points(colour: Colour, radius: f64, points: Vec<P>) -> Self {
        Self::new(colour, Shape::Points { points, radius })
    }

    /// Crosses.
    pub(crate) fn crosses(colour: Colour, points: Vec<P>) -> Self {
        Self::new(colour, Shape::Crosses { points })
    }

    /// The area between two lines.
    pub(crate) fn band(colour: Colour, lower: Vec<P>, upper: Vec<P>) -> Self {
        Self::new(colour, Shape::Band { lower, upper })
    }

    /// Rectangles.
    pub(crate) fn bars(colour: Colour, bars: Vec<[P; 2]>) -> Self {
        Self::new(colour, Shape::Bars { bars })
    }

    /// A surface.
    pub(crate) fn surface(corners: Vec<Vec<Option<Corner<P>>>>, range: [f64; 2]) -> Self {
        Self::new(Colour::INK, Shape::Surface { corners, range })
    }

    /// Words.
    pub(crate) fn texts(texts: Vec<(P, String)>) -> Self {
        Self::new(Colour::INK, Shape::Texts { texts })
    }

    /// The mark with a name.
    pub(crate) fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The mark, through which others are seen.
    pub(crate) fn faded(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// All places.
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

    /// The mark at other places.
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
