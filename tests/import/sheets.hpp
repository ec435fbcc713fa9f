// One leaf-like sheet, with a seam in its texture, in every mesh format.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::test {

/// A trapezium in x and z, wider at z = 0 (the base), arched a little in y; the texture has two charts that
/// meet along the middle column.
struct SheetFile {
  int columns = 6, rows = 10;
  double width = 0.06, height = 0.1;
  std::vector<Vec3> points;  // file coordinates, Y up

  SheetFile() {
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i) {
        const double t = double(j) / rows, s = double(i) / columns;
        points.push_back(
            Vec3((0.5 + (s - 0.5) * (1 - 0.6 * t)) * width, 0.01 * t * t, t * height).unaryExpr([](double x) {
              return double(float(x));
            }));
      }
    }
    points[columns].x() = float(width);
  }

  int at(int i, int j) const { return j * (columns + 1) + i; }
  bool left(int cell) const { return cell < columns / 2; }

  // The corners of every cell, upwards: y is up when z runs against x.
  std::vector<std::array<int, 4>> cells() const {
    std::vector<std::array<int, 4>> result;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i)
        result.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
    return result;
  }

  double area() const {
    double sum = 0;
    for (const auto& c : cells()) {
      for (const auto& t : {std::array{c[0], c[1], c[2]}, std::array{c[0], c[2], c[3]}}) {
        const Vec3 a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]];
        sum += std::sqrt(a.squaredNorm() * b.squaredNorm() - a.dot(b) * a.dot(b)) / 2;
      }
    }
    return sum;
  }

  // u runs from 0 to 0.4 on the left chart, from 0.6 to 1 on the right one; v with z.
  Vec2 uv(int vertex, bool on_left) const {
    const double s = double(vertex % (columns + 1)) / columns;
    return {on_left ? 0.8 * s : 0.2 + 0.8 * s, points[vertex].z() / height};
  }

  std::string obj(bool quads = false, int turn_every = 0) const {
    std::string text;
    for (const Vec3& p : points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    const int n = static_cast<int>(points.size());
    for (const bool on_left : {true, false}) {
      for (int v = 0; v < n; ++v) text += fmt::format("vt {} {}\n", uv(v, on_left).x(), uv(v, on_left).y());
    }
    int count = 0;
    for (std::size_t c = 0; c < cells().size(); ++c) {
      const auto q = cells()[c];
      const int shift = left(static_cast<int>(c) % columns) ? 1 : n + 1;
      const auto corner = [&](int v) { return fmt::format(" {}/{}", v + 1, v + shift); };
      if (quads) {
        text += "f" + corner(q[0]) + corner(q[1]) + corner(q[2]) + corner(q[3]) + "\n";
        continue;
      }
      for (auto t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
        if (turn_every > 0 && ++count % turn_every == 0) std::swap(t[1], t[2]);
        text += "f" + corner(t[0]) + corner(t[1]) + corner(t[2]) + "\n";
      }
    }
    return text;
  }

  /// Two objects that meet along the middle column, one of them moved by `gap`.
  std::string halves_obj(double gap) const {
    std::string text;
    for (const Vec3& p : points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    for (const Vec3& p : points) text += fmt::format("v {} {} {}\n", p.x(), p.y() + gap, p.z());
    for (std::size_t c = 0; c < cells().size(); ++c) {
      const auto q = cells()[c];
      const int shift = left(static_cast<int>(c) % columns) ? 1 : static_cast<int>(points.size()) + 1;
      text += fmt::format("f {} {} {} {}\n", q[0] + shift, q[1] + shift, q[2] + shift, q[3] + shift);
    }
    return text;
  }

  std::string ply() const {
    std::string text = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        points.size(), cells().size());
    for (const Vec3& p : points) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
    for (const auto& q : cells()) text += fmt::format("4 {} {} {} {}\n", q[0], q[1], q[2], q[3]);
    return text;
  }

  std::string stl() const {
    std::string text = "solid sheet\n";
    for (const auto& q : cells()) {
      for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
        text += "facet normal 0 1 0\nouter loop\n";
        for (const int v : t)
          text += fmt::format("vertex {} {} {}\n", points[v].x(), points[v].y(), points[v].z());
        text += "endloop\nendfacet\n";
      }
    }
    return text + "endsolid sheet\n";
  }

  /// sheet.bin: positions and texture coordinates of both charts' vertices (float), then indices (uint16).
  std::string gltf_buffer() const {
    std::string bytes;
    const auto put = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const int n = static_cast<int>(points.size());
    for (int chart = 0; chart < 2; ++chart) {
      for (const Vec3& p : points) {
        for (int k = 0; k < 3; ++k) put(float(p[k]));
      }
    }
    for (const bool on_left : {true, false}) {
      for (int v = 0; v < n; ++v) {
        put(float(uv(v, on_left).x()));
        put(float(1 - uv(v, on_left).y()));
      }
    }
    for (std::size_t c = 0; c < cells().size(); ++c) {
      const auto q = cells()[c];
      const int shift = left(static_cast<int>(c) % columns) ? 0 : n;
      for (const int v : {q[0], q[1], q[2], q[0], q[2], q[3]}) put(static_cast<std::uint16_t>(v + shift));
    }
    return bytes;
  }

  /// Refers to sheet.bin; `placement` is put into the node.
  std::string gltf(const std::string& placement = "") const {
    const std::size_t n = 2 * points.size(), indices = 6 * cells().size();
    return fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],"
        "\"nodes\":[{{{}\"mesh\":0}}],"
        "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"TEXCOORD_0\":1}},\"indices\":2}}]}"
        "}],"
        "\"buffers\":[{{\"uri\":\"sheet.bin\",\"byteLength\":{}}}],"
        "\"bufferViews\":[{{\"buffer\":0,\"byteOffset\":0,\"byteLength\":{}}},"
        "{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}},{{\"buffer\":0,\"byteOffset\":{},"
        "\"byteLength\":{}}}],"
        "\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":{},\"type\":\"VEC3\",\"min\":[0,"
        "0,0],"
        "\"max\":[1,1,1]}},{{\"bufferView\":1,\"componentType\":5126,\"count\":{},\"type\":\"VEC2\"}},"
        "{{\"bufferView\":2,\"componentType\":5123,\"count\":{},\"type\":\"SCALAR\"}}]}}",
        placement, 20 * n + 2 * indices, 12 * n, 12 * n, 8 * n, 20 * n, 2 * indices, n, n, indices);
  }
};

}  // namespace wilt::test
