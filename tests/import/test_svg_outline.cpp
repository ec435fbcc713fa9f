#include <fmt/format.h>

#include <numbers>

#include "import/files.hpp"
#include "wilt/core/error.hpp"
#include "wilt/import/leaf_in_memory.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

using SvgOutline = test::Files;

ReadOptions small() {
  ReadOptions options;
  options.vertices = 300;
  return options;
}

std::string svg(const std::string& body, const std::string& attributes = "viewBox=\"0 0 400 400\"") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">" + body + "</svg>";
}

constexpr double kUnit = 25.4 / 96 / 1000;  // metres

/// The area of the leaf in the drawing's units squared.
double drawn_area(const Leaf& leaf) {
  return surface_area(leaf.mesh, leaf.positions) / (kUnit * kUnit);
}

// Every area below is compared within 4 %: the margin of a mesh of 300 vertices is sampled at its edge
// length, which rounds corners by about an edge and cuts arcs by h^2 / 8r.
#define EXPECT_AREA(leaf, area) EXPECT_NEAR(drawn_area(leaf), area, 0.04 * (area)) << test::notes_of(leaf)

// Oracle: the area of an ellipse drawn as such, by arcs, by cubics, as a polygon: the same leaf.
TEST_F(SvgOutline, ReadsEllipsesArcsCurvesAndPolygons) {
  const double area = std::numbers::pi * 100 * 50;
  const double k = 4.0 / 3.0 * (std::sqrt(2.0) - 1.0);  // the circle as four cubics
  std::string polygon;
  for (int i = 0; i < 200; ++i) {
    const double t = 2 * std::numbers::pi * i / 200;
    polygon += fmt::format("{},{} ", 200 + 100 * std::cos(t), 200 + 50 * std::sin(t));
  }
  for (const std::string& shape :
       {std::string("<ellipse cx='200' cy='200' rx='100' ry='50'/>"),
        std::string("<path d='M100,200a100 50 0 0 1 200 0A100,50 0 01100,200z'/>"),
        fmt::format(
            "<path d='M300,200C300,{0} {1},250 200,250S100,{0} 100,200 {2},150 200,150 300,{3} 300,200'/>",
            200 + 50 * k, 200 + 100 * k, 200 - 100 * k, 200 - 50 * k),
        "<polygon points='" + polygon + "'/>"}) {
    const Leaf leaf = read_leaf(write("e.svg", svg(shape)), small());
    EXPECT_AREA(leaf, area) << shape;
    EXPECT_NEAR(leaf_length(leaf) / kUnit, 200, 8) << shape;
  }
}

// Oracle: the product of the transforms by hand: area scales with 2 * 3, and the ellipse lies upright.
TEST_F(SvgOutline, AppliesNestedTransforms) {
  const Leaf leaf = read_leaf(
      write("t.svg", svg("<g transform='translate(100,50) scale(2)'><g transform='rotate(90)'>"
                         "<rect width='40' height='20' transform='scale(3,1) translate(5 -40)'/></g></g>")),
      small());
  EXPECT_AREA(leaf, 40 * 20 * 12.0);
  // Corners of the rectangle: x' = 100 + 2 * -(y), y' = 50 + 2 * 3 * x; (5, -40) goes to (180, 80).
  ReadOptions options = small();
  options.petiole = Vec2(180, 80);
  const Leaf held = read_leaf(write("t.svg", svg("<g transform='translate(100,50) scale(2)'><g "
                                                 "transform='rotate(90)'><rect width='40' height='20' "
                                                 "transform='scale(3,1) translate(5 -40)'/></g></g>")),
                              options);
  EXPECT_LT((held.placement.translation - Vec3(180, -80, 0)).norm(), 5) << held.placement.translation;
}

// Oracle: the fill rules of SVG: two nested rings, one way round and the other.
TEST_F(SvgOutline, FollowsTheFillRule) {
  const std::string rings = "M0,0H200V200H0ZM50,50H150V150H50Z",
                    opposite = "M0,0H200V200H0ZM50,50V150H150V50Z";
  const auto loops = [&](const std::string& d, const std::string& rule) {
    const Leaf leaf = read_leaf(
        write("f.svg", svg(fmt::format("<path fill='green' d='{}' fill-rule='{}'/>", d, rule))), small());
    return leaf.mesh.boundary_loops().size();
  };
  EXPECT_EQ(loops(rings, "evenodd"), 2u);
  EXPECT_EQ(loops(rings, "nonzero"), 1u);
  EXPECT_EQ(loops(opposite, "nonzero"), 2u);
}

const char* const kLeafPath = "M0,0C60,-40 140,-40 200,0C140,40 60,40 0,0Z";  // a lens 200 long

std::string lens(const std::string& attributes) {
  return fmt::format("<path d='{}' transform='translate(50,100)' {}/>", kLeafPath, attributes);
}
std::string dot(const std::string& attributes) {
  return fmt::format("<circle cx='350' cy='350' r='30' {}/>", attributes);
}
const double kDotArea = std::numbers::pi * 900;

// Oracle: which of two shapes is filled, and so chosen; the dot is the smaller one.
TEST_F(SvgOutline, ChoosesOnlyFilledShapes) {
  const auto dot_chosen = [&](const std::string& body) {
    return std::abs(drawn_area(read_leaf(write("c.svg", svg(body)), small())) - kDotArea) < 0.1 * kDotArea;
  };
  EXPECT_FALSE(dot_chosen(lens("fill='green'") + dot("fill='green'")));
  EXPECT_TRUE(dot_chosen(lens("fill='none' stroke='green' stroke-width='4'") + dot("fill='green'")));
  EXPECT_TRUE(dot_chosen(lens("style='fill:none;stroke:#000'") + dot("")));
  EXPECT_TRUE(dot_chosen("<g fill='none'>" + lens("") + dot("fill='red'") + "</g>"));
  EXPECT_TRUE(dot_chosen("<style>/* no */ .a, #x { fill: none } path{fill:red}</style>" +
                         lens("class='b a'") + dot("")));
  EXPECT_TRUE(dot_chosen("<g display='none'>" + lens("") + "</g>" + dot("")));
  EXPECT_TRUE(dot_chosen("<defs>" + lens("") + "</defs><clipPath>" + lens("") + "</clipPath>" + dot("")));
  EXPECT_FALSE(
      dot_chosen("<defs><linearGradient id='g'/></defs>" + lens("fill='url(#g)'") + dot("fill='red'")));
  EXPECT_FALSE(dot_chosen("<defs>" + lens("id='l'") + "</defs><use href='#l' x='3'/>" + dot("")));
}

// Oracle: the coloured lens is the leaf although its shadow, blurred or grey, is as large or larger; a page
// of paper under it and a copy on top of it change nothing.
TEST_F(SvgOutline, LeavesShadowsPagesAndCopiesOut) {
  const std::string leaf = lens("fill='#4a7'");
  ReadOptions held = small();
  held.petiole = Vec2(50, 100);  // both ends of the lens are alike
  const Leaf alone = read_leaf(write("s.svg", svg(leaf)), held);
  const std::string grey =
      "<path d='M0,0C60,-42 140,-42 202,0C140,42 60,42 0,0Z' transform='translate(58,108)' fill='#616161'/>";
  const std::string blur =
      "<filter id='b'><feGaussianBlur/></filter><ellipse cx='150' cy='110' rx='130' "
      "ry='50' style='fill:#333;filter:url(#b)'/>";
  const std::string faint = "<ellipse cx='150' cy='110' rx='130' ry='50' fill='#250' opacity='0.3'/>";
  const std::string page = "<rect width='100%' height='100%' fill='#fff'/>";
  for (const std::string& body : {grey + leaf, blur + leaf, faint + leaf, page + leaf, leaf + leaf}) {
    const Leaf read = read_leaf(write("s.svg", svg(body)), held);
    EXPECT_NEAR(drawn_area(read), drawn_area(alone), 0.005 * drawn_area(alone)) << body;
    EXPECT_LT((read.placement.translation - alone.placement.translation).norm(), 2.0) << body;
    ReadOptions second = small();
    second.nth = 2;
    EXPECT_NE(refusal(write("s.svg", svg(body)), second).find("1 leaf-like shape;"), std::string::npos)
        << body;
  }
  EXPECT_TRUE(test::has_note(read_leaf(write("s.svg", svg(grey + leaf)), small()), "shadows"));
}

// Oracle: the areas of three lenses of different size, one of them with a vein.
TEST_F(SvgOutline, TakesTheNthLargest) {
  const auto scaled = [](double scale, int y) {
    return fmt::format("<g transform='translate(20,{}) scale({})'><path d='{}' fill='green'/></g>", y, scale,
                       kLeafPath);
  };
  const std::string vein = "<path d='M30,98h150v4h-150z' fill='#dfd'/>";
  const std::string body = scaled(0.5, 30) + scaled(1.0, 100) + vein + scaled(0.8, 200);
  double areas[3];
  for (int n = 1; n <= 3; ++n) {
    ReadOptions options = small();
    options.nth = n;
    areas[n - 1] = drawn_area(read_leaf(write("n.svg", svg(body)), options));
  }
  EXPECT_NEAR(areas[1] / areas[0], 0.64, 0.02);
  EXPECT_NEAR(areas[2] / areas[0], 0.25, 0.02);
  ReadOptions options = small();
  options.nth = 4;
  EXPECT_NE(refusal(write("n.svg", svg(body)), options).find("3 leaf-like shapes; --leaf 4"),
            std::string::npos);
}

// Oracle: the stalk's own place and length, drawn with the blade or as a shape of its own.
TEST_F(SvgOutline, CutsTheStalkOff) {
  const std::string apart =
      "<circle cx='200' cy='120' r='100' fill='green'/>"
      "<rect x='196' y='215' width='8' height='100' fill='brown'/>";
  const std::string drawn = "<path fill='green' d='M196,219.92A100,100 0 1 1 204,219.92V315H196Z'/>";
  for (const std::string& body : {apart, drawn}) {
    const Leaf leaf = read_leaf(write("stalk.svg", svg(body)), small());
    EXPECT_LT((leaf.placement.translation - Vec3(200, -220, 0)).norm(), 10) << body;
    EXPECT_AREA(leaf, std::numbers::pi * 1e4) << body;
    ASSERT_GE(leaf.stalk.centreline.rows(), 2) << body << test::notes_of(leaf);
    const Vec3 end = leaf.stalk.centreline.bottomRows<1>();
    EXPECT_EQ(leaf.stalk.centreline.row(0).norm(), 0.0);
    EXPECT_NEAR(end.norm() / kUnit, 95, 12) << body;
    EXPECT_LT(end.y(), 0.0) << "the stalk leads away from the blade";
    EXPECT_NEAR(leaf.stalk.radii.back() / kUnit, 4, 0.6) << body;
  }
}

// Oracle: the definition of the units; a mesh this coarse cuts 2.5 % off the lens's two tips.
TEST_F(SvgOutline, TakesTheScaleFromPhysicalSizes) {
  const auto expect_length = [&](const std::string& attributes, double millimetres) {
    const Leaf leaf = read_leaf(write("u.svg", svg(lens("fill='green'"), attributes)), small());
    EXPECT_NEAR(leaf_length(leaf) * 1000, millimetres, 0.04 * millimetres) << attributes;
  };
  expect_length("viewBox='0 0 400 400'", 200 * 25.4 / 96);
  expect_length("width='800px' height='800px' viewBox='0 0 400 400'", 200 * 25.4 / 96);
  expect_length("width='160mm' height='200mm' viewBox='0 0 400 400'", 80.0);
  expect_length("width='4in' height='4in' viewBox='0 0 400 400'", 50.8);
}

TEST_F(SvgOutline, RefusesWhatIsNoDrawingOfALeaf) {
  const auto message = [&](const std::string& text) { return refusal(write("x.svg", text)); };
  EXPECT_NE(message("<svg><path").find("cannot be read as SVG"), std::string::npos);
  EXPECT_NE(message("<html/>").find("root element is <html>"), std::string::npos);
  EXPECT_NE(message(svg("<line x1='0' y1='0' x2='9' y2='9'/>")).find("no filled path"), std::string::npos);
  EXPECT_NE(message(svg("<path d='M0,0 L oops'/>")).find("path data \"M0,0 L oops\""), std::string::npos);
  EXPECT_NE(message(svg("<g transform='turn(3)'>" + lens("") + "</g>")).find("transform \"turn(3)\""),
            std::string::npos);
}

// Negative: what stands in a file of 1 MB may be 101 MB of shapes, or nested deeper than any stack.
TEST_F(SvgOutline, RefusesWhatGrowsWithoutEnd) {
  std::string data, copies, deep;
  while (data.size() < 1'000'000) data += "M0,0h9v9z";
  for (int i = 0; i < 101; ++i) copies += "<use href='#a'/>";
  for (int i = 0; i < 200'000; ++i) deep += "<g>";
  const auto message = [&](const std::string& text) { return refusal(write("x.svg", text)); };
  EXPECT_NE(message(svg("<path id='a' d='" + data + "'/>" + copies)).find("more than 100 MB of shapes"),
            std::string::npos);
  for (int i = 0; i < 200'000; ++i) deep += "</g>";
  EXPECT_NE(message(svg(deep)).find("no filled path"), std::string::npos);
}

// Past crash: svgpp looks up words of ASCII alone. A gradient may have any name.
TEST_F(SvgOutline, TakesNoOtherLettersThanAsciiForWords) {
  const auto message = [&](const std::string& text) { return refusal(write("x.svg", text)); };
  EXPECT_NE(message(svg("<path d='M0,0 L9,9 \u00e9'/>")).find("path data"), std::string::npos);
  EXPECT_NE(message(svg("<g transform='r\u00f6tate(3)'>" + lens("") + "</g>")).find("transform"),
            std::string::npos);
  EXPECT_GT(drawn_area(read_leaf(write("x.svg", svg(lens("fill='gr\u00fcn'"))), small())), 0.0);
  EXPECT_GT(drawn_area(read_leaf(write("x.svg", svg(lens("fill='url(#gr\u00fcn)'"))), small())), 0.0);
}

// Oracle: the same drawing as a file. Groups, a style sheet, <use> and the drawing's size count.
TEST_F(SvgOutline, IsTheSameFromAFileAndFromAListOfElements) {
  const std::string file =
      svg("<style>.leaf { fill: #3a5 }</style><defs><ellipse id='e' rx='9' ry='5'/></defs>"
          "<g transform='scale(3)'><use href='#e' x='60' y='50' class='leaf'/></g>",
          "viewBox='0 0 400 400' width='80mm' height='80mm'");
  const std::string list =
      R"json([[0, "svg", {"viewBox": "0 0 400 400", "width": "80mm", "height": "80mm"}, ""],
              [1, "style", {}, ".leaf { fill: #3a5 }"],
              [1, "defs", {}, ""], [2, "ellipse", {"id": "e", "rx": "9", "ry": "5"}, ""],
              [1, "g", {"transform": "scale(3)"}, ""],
              [2, "use", {"href": "#e", "x": "60", "y": "50", "class": "leaf"}, ""]])json";
  const Leaf read = read_leaf(write("e.svg", file), small());
  const Leaf listed = leaf_from_drawing(drawn_from_elements(list, 1), "e", small());
  EXPECT_EQ(read.positions, listed.positions);
  EXPECT_EQ(read.notes, listed.notes);
  EXPECT_THROW(drawn_from_elements("[[0]]", 1), Error);
  EXPECT_THROW(drawn_from_elements("[]", 1), Error);
}

}  // namespace
}  // namespace wilt
