// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/plot.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace sheaf {
namespace {

// In units of an SVG pixel; a PNG has kPngScale pixels for each.
constexpr double kWidth = 900;
constexpr double kHeight = 540;
constexpr double kPngScale = 1.5;
constexpr double kLeft = 90;
constexpr double kRight = 210;  // room for the legend
constexpr double kTop = 44;
constexpr double kBottom = 60;
constexpr double kTextSize = 13;
constexpr double kMarkRadius = 4;

struct Color {
  double red, green, blue;
};
constexpr Color kInk{0.15, 0.15, 0.15};
constexpr Color kGrid{0.88, 0.88, 0.88};
// Distinguishable without full colour vision: M. Okabe and K. Ito, "Color Universal Design", 2008.
constexpr std::array<Color, 7> kPalette{{{0.000, 0.447, 0.698},
                                         {0.835, 0.369, 0.000},
                                         {0.000, 0.620, 0.451},
                                         {0.800, 0.475, 0.655},
                                         {0.902, 0.624, 0.000},
                                         {0.337, 0.706, 0.914},
                                         {0.400, 0.400, 0.400}}};

enum class Anchor : std::uint8_t { kStart, kMiddle, kEnd };

class Drawing {
 public:
  Drawing(cairo_surface_t* surface, const Plot& plot)
      : cairo_(cairo_create(surface), cairo_destroy),
        plot_(plot),
        x_(plot.x.scale),
        y_(plot.y.scale) {
    cairo_select_font_face(context(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    measure();
  }

  void draw() {
    set_color({1, 1, 1});
    cairo_paint(context());
    draw_axes();
    draw_marks();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw_series(plot_.series[i], color_of(i));
    draw_legend();
    set_color(kInk);
    text(plot_.title, kLeft, kTop - 18, Anchor::kStart, kTextSize + 3);
  }

 private:
  static Color color_of(std::size_t series) { return kPalette[series % kPalette.size()]; }

  [[nodiscard]] cairo_t* context() { return cairo_.get(); }
  void set_color(const Color& color) {
    cairo_set_source_rgb(context(), color.red, color.green, color.blue);
  }

  [[nodiscard]] bool can_show(const PlotPoint& point) const {
    return x_.can_show(point.x) && y_.can_show(point.y);
  }
  [[nodiscard]] double column(double x) const {
    return kLeft + x_.position(x) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double row(double y) const {
    return kHeight - kBottom - y_.position(y) * (kHeight - kTop - kBottom);
  }

  void measure() {
    for (const PlotSeries& series : plot_.series) {
      for (const PlotPoint& point : series.points) {
        if (!can_show(point)) continue;
        x_.include(point.x);
        y_.include(point.y);
      }
    }
    for (const PlotMark& mark : plot_.marks) {
      if (x_.can_show(mark.x)) x_.include(mark.x);
    }
    x_.round();
    y_.round();
  }

  void text(const std::string& what, double x, double y, Anchor anchor, double size = kTextSize) {
    cairo_set_font_size(context(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(context(), what.c_str(), &extents);
    const double shift = anchor == Anchor::kStart    ? 0
                         : anchor == Anchor::kMiddle ? extents.x_advance / 2
                                                     : extents.x_advance;
    cairo_move_to(context(), x - shift, y);
    cairo_show_text(context(), what.c_str());
  }

  void line(double x0, double y0, double x1, double y1) {
    cairo_move_to(context(), x0, y0);
    cairo_line_to(context(), x1, y1);
    cairo_stroke(context());
  }

  static std::string tick_text(const PlotAxis& axis, double value) {
    return axis.tick_text ? axis.tick_text(value) : fmt::format("{:g}", value);
  }

  void draw_axes() {
    cairo_set_line_width(context(), 1);
    const double bottom = kHeight - kBottom;
    const double right = kWidth - kRight;
    for (const double tick : x_.ticks()) {
      set_color(kGrid);
      line(column(tick), kTop, column(tick), bottom);
      set_color(kInk);
      text(tick_text(plot_.x, tick), column(tick), bottom + 18, Anchor::kMiddle);
    }
    for (const double tick : y_.ticks()) {
      set_color(kGrid);
      line(kLeft, row(tick), right, row(tick));
      set_color(kInk);
      text(tick_text(plot_.y, tick), kLeft - 8, row(tick) + 4, Anchor::kEnd);
    }
    line(kLeft, bottom, right, bottom);
    line(kLeft, kTop, kLeft, bottom);
    text(plot_.x.label, (kLeft + right) / 2, kHeight - 14, Anchor::kMiddle);
    cairo_save(context());
    cairo_translate(context(), 20, (kTop + bottom) / 2);
    cairo_rotate(context(), -std::numbers::pi / 2);
    text(plot_.y.label, 0, 0, Anchor::kMiddle);
    cairo_restore(context());
  }

  void draw_marks() {
    constexpr double kDash = 4;
    double height = kTop + kTextSize;
    for (const PlotMark& mark : plot_.marks) {
      if (!x_.can_show(mark.x)) continue;
      set_color(kInk);
      cairo_set_dash(context(), &kDash, 1, 0);
      line(column(mark.x), kTop, column(mark.x), kHeight - kBottom);
      cairo_set_dash(context(), nullptr, 0, 0);
      text(mark.label, column(mark.x) + 4, height, Anchor::kStart, kTextSize - 2);
      height += kTextSize;
    }
  }

  void dot(double x, double y) {
    cairo_arc(context(), x, y, kMarkRadius, 0, 2 * std::numbers::pi);
    cairo_fill(context());
  }

  void draw_series(const PlotSeries& series, const Color& color) {
    set_color(color);
    cairo_set_line_width(context(), 2);
    cairo_set_line_cap(context(), CAIRO_LINE_CAP_ROUND);  // shows a point between two interruptions
    if (series.style != PlotStyle::kMarks) {
      bool interrupted = true;
      for (const PlotPoint& point : series.points) {
        if (can_show(point)) {
          if (interrupted) cairo_move_to(context(), column(point.x), row(point.y));
          cairo_line_to(context(), column(point.x), row(point.y));
        }
        interrupted = !can_show(point);
      }
      cairo_stroke(context());
    }
    for (const PlotPoint& point : series.points) {
      if (!can_show(point)) continue;
      if (series.style != PlotStyle::kLine) dot(column(point.x), row(point.y));
      text(point.label, column(point.x) + 7, row(point.y) - 6, Anchor::kStart, kTextSize - 2);
    }
  }

  void draw_legend() {
    const double left = kWidth - kRight + 20;
    double y = kTop + kTextSize;
    for (std::size_t i = 0; i < plot_.series.size(); ++i, y += kTextSize + 7) {
      set_color(color_of(i));
      cairo_set_line_width(context(), 2);
      if (plot_.series[i].style != PlotStyle::kMarks) line(left, y - 4, left + 20, y - 4);
      if (plot_.series[i].style != PlotStyle::kLine) dot(left + 10, y - 4);
      set_color(kInk);
      text(plot_.series[i].name, left + 28, y, Anchor::kStart);
    }
  }

  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
  const Plot& plot_;
  AxisRange x_;
  AxisRange y_;
};

using Bytes8 = std::vector<std::uint8_t>;
using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  auto& to = *static_cast<Bytes8*>(bytes);
  to.insert(to.end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(fmt::format("drawing a plot: {}", cairo_status_to_string(status)));
  }
}

// Cairo numbers all surfaces of a process and writes that number, which nothing refers to.
void remove_number(Bytes8& svg) {
  constexpr std::string_view kName = " id=\"surface";
  const auto name = std::search(svg.begin(), svg.end(), kName.begin(), kName.end());
  if (name == svg.end()) return;
  svg.erase(name, std::find(name, svg.end(), '>'));
}

}  // namespace

std::vector<std::uint8_t> plot_svg(const Plot& plot) {
  Bytes8 bytes;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, kWidth, kHeight),
                        cairo_surface_destroy);
  Drawing(surface.get(), plot).draw();
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  remove_number(bytes);
  return bytes;
}

std::vector<std::uint8_t> plot_png(const Plot& plot) {
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(kWidth * kPngScale),
                                 static_cast<int>(kHeight * kPngScale)),
      cairo_surface_destroy);
  cairo_surface_set_device_scale(surface.get(), kPngScale, kPngScale);
  Drawing(surface.get(), plot).draw();
  Bytes8 bytes;
  require(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  return bytes;
}

}  // namespace sheaf
