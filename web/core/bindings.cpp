// The studio's core as a JavaScript module (embind). What a call gives: web/src/core/wasm.d.ts.
//
// A call gives {value} or, when wilt refuses, {error: message}: exceptions of WebAssembly carry no text.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "leaf_source.hpp"
#include "petiole_places.hpp"
#include "values.hpp"
#include "wilt/core/version.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/studio/live_frame.hpp"
#include "wilt/studio/session.hpp"
#include "wilt/studio/settings_json.hpp"

namespace wilt::web {
namespace {

template <class Work>
val guarded(const Work& work) {
  val result = val::object();
  try {
    result.set("value", work());
  } catch (const std::bad_alloc&) {
    result.set("error", std::string("it takes more memory than a page has; take fewer vertices"));
  } catch (const std::exception& error) {
    result.set("error", std::string(error.what()));
  }
  return result;
}

template <class Row>
val by_region(const std::vector<ForceRow>& forces, int iteration, const Row& value) {
  std::vector<double> means(4, 0.0);
  for (auto row = forces.rbegin(); row != forces.rend() && row->iteration == iteration; ++row)
    means[static_cast<std::size_t>(row->region)] = value(*row);
  return numbers(means);
}

val forces_value(const Simulation& simulation) {
  const std::vector<ForceRow>& rows = simulation.result().forces;
  const int now = simulation.iteration();
  val forces = val::object();
  forces.set("elastic", by_region(rows, now, [](const ForceRow& row) { return row.elastic; }));
  forces.set("damping", by_region(rows, now, [](const ForceRow& row) { return row.damping; }));
  forces.set("swelling", by_region(rows, now, [](const ForceRow& row) { return row.swelling; }));
  forces.set("external", by_region(rows, now, [](const ForceRow& row) { return row.external; }));
  forces.set("water", by_region(rows, now, [](const ForceRow& row) { return row.water; }));
  forces.set("pressure", by_region(rows, now, [](const ForceRow& row) { return row.pressure; }));
  return forces;
}

val frame_value(const StudioSession& session) {
  const LiveFrame live = live_frame(session);
  const Simulation& simulation = session.simulation();
  const FrameMetrics metrics = simulation.metrics();
  val frame = val::object();
  frame.set("iteration", simulation.iteration());
  frame.set("positions", typed(live.positions));
  frame.set("normals", typed(live.normals));
  frame.set("colours", typed(live.colours));
  frame.set("stalkPositions", typed(live.stalk_positions));
  frame.set("stalkNormals", typed(live.stalk_normals));
  frame.set("stalkColour", numbers({live.stalk_colour.begin(), live.stalk_colour.end()}));
  frame.set("veins", typed(live.veins));
  val fields = val::object();
  for (std::size_t k = 0; k < live.fields.size(); ++k)
    fields.set(LiveFrame::kFields[k], typed(live.fields[k]));
  frame.set("fields", fields);
  frame.set("tipForces", typed(live.tip_forces));
  frame.set("wrinkle", metrics.wrinkle);
  frame.set("curl", metrics.curl * 180.0 / M_PI);
  frame.set("areaRatio", metrics.area_ratio);
  frame.set("waterLeft", live.water_left);
  frame.set("forces", forces_value(simulation));
  frame.set("ended", simulation.ended());
  frame.set("stopped", simulation.result().stop_reason);
  return frame;
}

val tips_value(const StudioSession& session, const LiveLeaf& live) {
  val tips = val::array();
  for (std::size_t i = 0; i < session.venation().tips.size(); ++i) {
    const Tip& tip = session.venation().tips[i];
    val one = val::object();
    one.set("index", static_cast<int>(i));
    one.set("point", live.tip_points[i]);
    one.set("s", tip.s);
    one.set("d", tip.d);
    one.set("prominence", tip.prominence);
    tips.call<void>("push", one);
  }
  return tips;
}

val info_value(const StudioSession& session, const val& source) {
  const LiveLeaf live = live_leaf(session);
  const Leaf& leaf = session.leaf();
  const MarginProfile& profile = session.venation().margin;
  val info = val::object();
  info.set("name", leaf.name);
  info.set("species", session.config().species);
  info.set("vertices", leaf.mesh.num_vertices());
  info.set("length", leaf_length(leaf));
  val notes = val::array();
  for (const std::string& note : leaf.notes) notes.call<void>("push", note);
  if (!session.simulation().result().note.empty())
    notes.call<void>("push", session.simulation().result().note);
  info.set("notes", notes);
  info.set("points", static_cast<int>(live.vertex.size()));
  info.set("vertex", typed(live.vertex));
  info.set("faces", typed(live.faces));
  info.set("uv", typed(live.uv));
  info.set("stalkPoints", live.stalk_points);
  info.set("stalkFaces", typed(live.stalk_faces));
  info.set("petiolePoint", live.petiole_point);
  info.set("tips", tips_value(session, live));
  val margin = val::object();
  margin.set("point", typed(live.margin_points));
  margin.set("s", typed(std::vector<float>(profile.s.begin(), profile.s.end())));
  margin.set("d", typed(std::vector<float>(profile.d.begin(), profile.d.end())));
  margin.set("perimeter", profile.perimeter);
  margin.set("place", typed(petiole_places(source, leaf, profile)));
  info.set("margin", margin);
  info.set("veinStart", typed(live.vein_start));
  info.set("veinOrder", typed(live.vein_order));
  info.set("hasPhoto", leaf.photo != nullptr);
  return info;
}

// One leaf and its run. `load` must have succeeded before anything else is called.
class Studio {
 public:
  val load(const val& source, const val& edits, const std::string& toml) {
    return guarded([&] {
      const VeinEdits vein_edits{doubles(edits["added"]), doubles(edits["removed"])};
      auto fresh = std::make_unique<StudioSession>(leaf_of(source), vein_edits, preset_of(source),
                                                   given_with(source), toml);
      session_ = std::move(fresh);
      return info_value(*session_, source);
    });
  }
  val start(const std::string& toml) {
    return guarded([&] {
      session_->start(toml);
      return frame_value(*session_);
    });
  }
  val frame() {
    return guarded([&] { return frame_value(*session_); });
  }
  /// Without making a record of it.
  val step() {
    return guarded([&] {
      session_->step();
      return val(session_->simulation().iteration());
    });
  }
  val change(const std::string& key, const std::string& value) {
    return guarded([&] {
      session_->change(key, value);
      return val::undefined();
    });
  }
  val rewind(int iteration) {
    return guarded([&] {
      session_->rewind(iteration);
      return frame_value(*session_);
    });
  }
  val settings() {
    return guarded([&] { return val(settings_json(session_->settings_now())); });
  }
  val toml(bool full) {
    return guarded([&] { return val(full ? session_->file("toml") : unusual_toml(session_->config())); });
  }
  /// JPEGs: {colour, normal}, or nothing where the leaf carries no texture.
  val texture(int size) {
    return guarded([&] {
      session_->paint_texture(size);
      const LeafPaint& paint = session_->paint();
      if (paint.texture().empty()) return val::undefined();
      val maps = val::object();
      maps.set("colour", bytes(paint.texture()));
      maps.set("normal", bytes(paint.normal_texture()));
      return maps;
    });
  }
  val file(const std::string& kind) {
    return guarded([&] { return bytes(session_->file(kind)); });
  }
  /// `margin`: x, y of each point, y up; the index of the point where the shape alone has the petiole.
  val notch(const val& margin) {
    return guarded([&] { return val(find_petiole(points2(margin)).index); });
  }
  val has_stalk(const val& margin) {
    return guarded([&] { return val(cut_stalk({points2(margin), {}}).found); });
  }

 private:
  std::unique_ptr<StudioSession> session_;
};

}  // namespace
}  // namespace wilt::web

EMSCRIPTEN_BINDINGS(wilt) {
  using wilt::web::Studio;
  emscripten::function(
      "version", +[] { return std::string(wilt::version()); });
  emscripten::class_<Studio>("Studio")
      .constructor<>()
      .function("load", &Studio::load)
      .function("start", &Studio::start)
      .function("frame", &Studio::frame)
      .function("step", &Studio::step)
      .function("change", &Studio::change)
      .function("rewind", &Studio::rewind)
      .function("settings", &Studio::settings)
      .function("toml", &Studio::toml)
      .function("texture", &Studio::texture)
      .function("file", &Studio::file)
      .function("notch", &Studio::notch)
      .function("hasStalk", &Studio::has_stalk);
}
