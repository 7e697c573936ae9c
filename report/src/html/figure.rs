//! The numbered figures of the pages about measurements.

use plotly::Plot;

/// What is drawn, in this order.
pub(super) struct Figures {
    drawn: Vec<String>,
    /// How many stand before these.
    before: usize,
}

impl Figures {
    pub(super) fn new() -> Self {
        Self { drawn: Vec::new(), before: 0 }
    }

    /// More of them, numbered on.
    pub(super) fn after(other: &Self) -> Self {
        Self { drawn: Vec::new(), before: other.before + other.drawn.len() }
    }

    /// Plots side by side under a title, so many pixels high.
    pub(super) fn add(&mut self, title: &str, plots: &[Plot], height: u32, caption: &str) {
        if plots.is_empty() {
            return;
        }
        let number = self.before + self.drawn.len() + 1;
        let panels = plots.iter().enumerate().map(|(i, plot)| {
            let id = format!("figure-{number}-{}", i + 1);
            format!(
                "<div class=\"plot\" style=\"height:{height}px\">{}</div>\n",
                plot.to_inline_html(Some(&id))
            )
        });
        let columns = match plots.len() {
            columns @ (1 | 2 | 4) => columns,
            _ => 3,
        };
        self.drawn.push(format!(
            "<figure>\n<h3>{number}. {title}</h3>\n<div class=\"plots of-{columns}\">\n{}</div>\n<figcaption>{caption}</figcaption>\n</figure>\n",
            panels.collect::<String>()
        ));
    }

    pub(super) fn html(&self) -> String {
        self.drawn.concat()
    }
}

/// The step at which no more than `most` of so many are drawn.
pub(super) fn step(count: usize, most: usize) -> usize {
    count.div_ceil(most).max(1)
}

/// What is to be said if not all are drawn.
pub(super) fn thinned(count: usize, step: usize) -> String {
    if step == 1 { String::new() } else { format!(" One in {step} of {count} is drawn.") }
}

/// Six digits: the file need not be longer.
pub(super) fn round(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
