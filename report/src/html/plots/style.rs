//! What all plots look like.

use plotly::common::{Font, Label, Title};
use plotly::configuration::ModeBarButtonName::{self, *};
use plotly::layout::{
    AspectMode, Axis, Camera, CameraCenter, Eye, HoverMode, LayoutScene, Margin, Projection, ProjectionType,
    Up,
};
use plotly::{Configuration, Layout, Plot};

use crate::axis::{FAINT, GREY, INK, css};

/// Buttons for what the mouse does as well; those to go back and to save a picture stay.
const SUPERFLUOUS: [ModeBarButtonName; 14] = [
    Zoom2d,
    Pan2d,
    Select2d,
    Lasso2d,
    ZoomIn2d,
    ZoomOut2d,
    AutoScale2d,
    HoverClosestCartesian,
    HoverCompareCartesian,
    Zoom3d,
    Pan3d,
    TableRotation,
    ResetCameraLastSave3d,
    HoverClosest3d,
];

/// An empty plot with this layout.
pub(crate) fn plot(layout: Layout) -> Plot {
    let mut plot = Plot::new();
    let hover = Label::new().background_color("#ffffff").font(font(12).color(css(INK, 1.0)));
    plot.set_layout(
        layout
            .font(font(12).color(css(INK, 1.0)))
            .paper_background_color("#ffffff")
            .plot_background_color("#ffffff")
            .show_legend(false)
            .hover_mode(HoverMode::Closest)
            .hover_label(hover),
    );
    let configuration = Configuration::new().display_logo(false).responsive(true);
    plot.set_configuration(configuration.mode_bar_buttons_to_remove(SUPERFLUOUS.to_vec()));
    plot
}

/// Text of a size.
pub(crate) fn font(size: usize) -> Font {
    Font::new().size(size).family("Helvetica, Arial, sans-serif")
}

/// Room on the left, right, top and bottom, pixels.
pub(crate) fn margin([left, right, top, bottom]: [usize; 4]) -> Margin {
    Margin::new().left(left).right(right).top(top).bottom(bottom)
}

/// An axis with a title.
pub(crate) fn axis(title: &str) -> Axis {
    axis_in_space(title).auto_margin(true)
}

/// One of the three of a space, which has no margins.
fn axis_in_space(title: &str) -> Axis {
    let title = Title::with_text(title).font(font(12).color(css(INK, 1.0)));
    Axis::new()
        .title(title)
        .grid_color(css(FAINT, 1.0))
        .zero_line_color(css(GREY, 0.6))
        .tick_font(font(11).color(css(GREY, 1.0)))
        .exponent_format(plotly::common::ExponentFormat::Power)
}

/// A space with three axes, seen from the corner; `up` is the axis that points up.
pub(crate) fn scene(titles: [&str; 3], aspect: AspectMode, up: usize, distance: f64) -> LayoutScene {
    let [x, y, z] = titles.map(axis_in_space);
    let unit = |axis: usize| f64::from(u8::from(axis == up));
    let eye = |axis: usize| distance * if axis == up { 0.6 } else { 0.95 };
    let camera = Camera::new()
        .up(Up::new().x(unit(0)).y(unit(1)).z(unit(2)))
        .center(CameraCenter::new().x(0.0).y(0.0).z(0.0))
        .eye(Eye::new().x(eye(0)).y(eye(1)).z(eye(2)))
        .projection(Projection::new().projection_type(ProjectionType::Orthographic));
    LayoutScene::new().x_axis(x).y_axis(y).z_axis(z).aspect_mode(aspect).camera(camera)
}
