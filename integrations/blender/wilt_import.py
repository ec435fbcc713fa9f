"""Blender add-on: File > Import > wilt result (.glb). Brings in the leaf with shape keys, ageing colours and material.

As an add-on: Edit > Preferences > Add-ons > Install, choose this file, switch it on.
Without a window: blender --background --python wilt_import.py -- leaf.glb --save leaf.blend [--render frame.png]

Blender's own glTF importer brings in shapes, but no colours that change. This one reads the GLB itself, so that it
does not depend on the importer's version: the colours of all frames stand in a mesh that no scene shows, and
a geometry-nodes modifier takes those of the current time. Nothing runs behind Blender's back while it plays.
"""
import argparse
import json
import math
import os
import struct
import sys
import tempfile

import bpy
import numpy as np

bl_info = {
    "name": "wilt result (.glb)",
    "author": "wilt",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "File > Import",
    "description": "A withering leaf with its shapes, ageing colours and material",
    "category": "Import-Export",
}

TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}
COLOUR = "wilt_colour"  # the attribute that the material shows
MOST_SAMPLES = 1 << 24  # colours that a node can count: its numbers are float32


# --- reading --------------------------------------------------------------------------------------------------


class Glb:
    """The arrays of a GLB that wilt wrote: everything inside, tightly packed, sparse where that is smaller."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        if len(data) < 20 or data[:4] != b"glTF":
            raise ValueError(f"'{path}' is no GLB; give a .glb that wilt wrote")
        size = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + size])
        self.binary = memoryview(data)[28 + size :]
        if "wilt" not in self.json["asset"].get("extras", {}):
            raise ValueError(f"'{path}' was not written by wilt; use File > Import > glTF 2.0 for it")

    def array(self, place, kind, count):
        start = self.json["bufferViews"][place["bufferView"]].get("byteOffset", 0) + place.get("byteOffset", 0)
        return np.frombuffer(self.binary, TYPES[kind], count, start)

    def accessor(self, number):
        accessor = self.json["accessors"][number]
        count, width, kind = accessor["count"], WIDTHS[accessor["type"]], accessor["componentType"]
        if "bufferView" in accessor:
            values = self.array(accessor, kind, count * width).reshape(count, width).copy()
        else:
            values = np.zeros((count, width), TYPES[kind])
        sparse = accessor.get("sparse")
        if sparse:
            rows = self.array(sparse["indices"], sparse["indices"]["componentType"], sparse["count"])
            values[rows] = self.array(sparse["values"], kind, sparse["count"] * width).reshape(-1, width)
        return values

    def attribute(self, primitive, name):
        return self.accessor(primitive["attributes"][name]) if name in primitive["attributes"] else None

    def frames(self, primitive, name):
        """Every frame's values; the base alone where nothing changes; none without the attribute."""
        base = self.attribute(primitive, name)
        if base is None:
            return []
        return [base + self.accessor(t[name]) for t in primitive.get("targets", []) if name in t] or [base]

    def image(self, texture):
        """Bytes of the picture behind a texture reference of a material, and the end of its name."""
        if texture is None:
            return None
        image = self.json["images"][self.json["textures"][texture["index"]]["source"]]
        view = self.json["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        ending = ".jpg" if image["mimeType"] == "image/jpeg" else ".png"
        return bytes(self.binary[start : start + view["byteLength"]]), ending

    def times(self):
        if not self.json.get("animations"):
            return [0.0]
        return self.accessor(self.json["animations"][0]["samplers"][0]["input"]).ravel().tolist()


def z_up(points):
    """From the file's Y up to Blender's Z up."""
    return np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)


# --- building -------------------------------------------------------------------------------------------------


def set_attribute(mesh, name, kind, values):
    field = {"FLOAT_COLOR": "color", "FLOAT": "value"}[kind]
    mesh.attributes.new(name, kind, "POINT").data.foreach_set(field, np.ascontiguousarray(values, np.float32).ravel())


def rgba(colours):
    return np.column_stack([colours, np.ones(len(colours))])


def build_object(glb, source, collection):
    """The object of a mesh of the file, with a shape key per frame."""
    (primitive,) = source["primitives"]
    shapes = [z_up(points) for points in glb.frames(primitive, "POSITION")]
    faces = glb.accessor(primitive["indices"]).reshape(-1, 3).astype(np.int32)
    mesh = bpy.data.meshes.new(source["name"])
    mesh.vertices.add(len(shapes[0]))
    mesh.vertices.foreach_set("co", shapes[0].astype(np.float32).ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    if bpy.app.version < (4, 1):  # later versions know it from the starts
        mesh.polygons.foreach_set("loop_total", np.full(len(faces), 3, np.int32))
    uv = glb.attribute(primitive, "TEXCOORD_0")
    if uv is not None:
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", np.column_stack([uv[:, 0], 1.0 - uv[:, 1]])[faces.ravel()].ravel())
    mesh.update(calc_edges=True)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    colours = glb.frames(primitive, "COLOR_0")
    set_attribute(mesh, COLOUR, "FLOAT_COLOR", rgba(colours[-1] if colours else np.ones((len(shapes[0]), 3))))
    water = glb.attribute(primitive, "_WATER")
    if water is not None:
        set_attribute(mesh, "wilt_water", "FLOAT", water)
    built = bpy.data.objects.new(source["name"], mesh)
    collection.objects.link(built)
    if len(shapes) > 1:
        names = source.get("extras", {}).get("targetNames", [f"frame {k}" for k in range(len(shapes))])
        built.shape_key_add(name="Basis", from_mix=False)
        for name, shape in zip(names, shapes):
            key = built.shape_key_add(name=name, from_mix=False)
            key.data.foreach_set("co", shape.astype(np.float32).ravel())
    return built, colours


def make_linear(animated):
    """Straight lines between the key frames of a data block, which Blender would ease."""
    animation = animated.animation_data
    if hasattr(animation.action, "fcurves"):
        curves = animation.action.fcurves
    else:  # from 5.0 on
        from bpy_extras import anim_utils

        curves = anim_utils.action_get_channelbag_for_slot(animation.action, animation.action_slot).fcurves
    for curve in curves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def animate_shapes(shape_keys, scene_frames):
    """Key k is fully on at frame k and off at its neighbours: in between two keys share, linearly."""
    last = len(scene_frames) - 1
    for k, key in enumerate(shape_keys.key_blocks[1:]):  # the first is the rest shape
        for frame in range(max(k - 1, 0), min(k + 1, last) + 1):
            key.value = 1.0 if frame == k else 0.0
            key.keyframe_insert("value", frame=scene_frames[frame])
    make_linear(shape_keys)


def colour_store(name, colours):
    """An object in no scene whose points carry the colours of all frames, one frame after the other."""
    points = len(colours) * len(colours[0])
    mesh = bpy.data.meshes.new(f"{name} colours")
    mesh.vertices.add(points)
    set_attribute(mesh, COLOUR, "FLOAT_COLOR", rgba(np.concatenate(colours)))
    return bpy.data.objects.new(f"{name} colours", mesh)


def socket(sockets, name, kind):
    """A socket by name and type: sample nodes hold one of every type under one name."""
    return next(s for s in sockets if s.name == name and s.type == kind)


def ageing_tree(name, store, points, scene_frames):
    """Geometry nodes: at time k + f point i has (1 - f) stored[k points + i] + f stored[(k + 1) points + i]."""
    tree = bpy.data.node_groups.new(f"{name} ageing", "GeometryNodeTree")
    if hasattr(tree, "interface"):  # from 4.0 on
        for direction in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    node, link = tree.nodes.new, tree.links.new

    def maths(operation, a, b=None):
        made = node("ShaderNodeMath")
        made.operation = operation
        for slot, value in zip(made.inputs, (a, b)):
            if isinstance(value, (int, float)):
                slot.default_value = value
            elif value is not None:
                link(value, slot)
        return made.outputs[0]

    time = node("ShaderNodeValue")
    time.label = "frame of the clip"
    for k, frame in enumerate(scene_frames):
        time.outputs[0].default_value = k
        time.outputs[0].keyframe_insert("default_value", frame=frame)
    make_linear(tree)
    whole = maths("FLOOR", time.outputs[0])
    index = node("GeometryNodeInputIndex").outputs[0]
    store_info = node("GeometryNodeObjectInfo")
    store_info.inputs["Object"].default_value = store
    stored = node("GeometryNodeInputNamedAttribute")
    stored.data_type = "FLOAT_COLOR"
    stored.inputs["Name"].default_value = COLOUR

    def colours_of(frame):
        sample = node("GeometryNodeSampleIndex")
        sample.data_type, sample.domain, sample.clamp = "FLOAT_COLOR", "POINT", True
        link(store_info.outputs["Geometry"], sample.inputs["Geometry"])
        link(socket(stored.outputs, "Attribute", "RGBA"), socket(sample.inputs, "Value", "RGBA"))
        link(maths("ADD", maths("MULTIPLY", frame, points), index), sample.inputs["Index"])
        return socket(sample.outputs, "Value", "RGBA")

    mix = node("ShaderNodeMix")
    mix.data_type = "RGBA"
    link(maths("FRACT", time.outputs[0]), mix.inputs[0])
    link(colours_of(whole), mix.inputs[6])
    link(colours_of(maths("ADD", whole, 1)), mix.inputs[7])
    put = node("GeometryNodeStoreNamedAttribute")
    put.data_type, put.domain = "FLOAT_COLOR", "POINT"
    put.inputs["Name"].default_value = COLOUR
    link(node("NodeGroupInput").outputs[0], put.inputs["Geometry"])
    link(mix.outputs[2], socket(put.inputs, "Value", "RGBA"))
    link(put.outputs["Geometry"], node("NodeGroupOutput").inputs[0])
    return tree


def load_image(picture, name, is_colour):
    data, ending = picture
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name + ending)
        with open(path, "wb") as file:
            file.write(data)
        image = bpy.data.images.load(path)
        image.pack()
    image.name = name
    if not is_colour:
        image.colorspace_settings.name = "Non-Color"
    return image


def build_material(name, texture, relief):
    """A thin leaf: texture x colour, a greyer underside, light that passes through (docs/method.md, section 10)."""
    material = bpy.data.materials.new(f"wilt {name}")
    material.use_nodes = True
    material.use_backface_culling = False
    tree = material.node_tree
    tree.nodes.clear()
    node, link = tree.nodes.new, tree.links.new

    def mixed(blend, factor, a, b):
        made = node("ShaderNodeMix")
        made.data_type, made.blend_type = "RGBA", blend
        for slot, value in ((made.inputs[0], factor), (made.inputs[6], a), (made.inputs[7], b)):
            if isinstance(value, float):
                slot.default_value = value if slot.type == "VALUE" else (value, value, value, 1.0)
            else:
                link(value, slot)
        return made.outputs[2]

    def picture(image):
        made = node("ShaderNodeTexImage")
        made.image = image
        return made.outputs["Color"]

    attribute = node("ShaderNodeAttribute")
    attribute.attribute_name = COLOUR
    upper = attribute.outputs["Color"]
    if texture:
        upper = mixed("MULTIPLY", 1.0, picture(load_image(texture, f"{name} colour", True)), upper)

    parts = node("ShaderNodeSeparateXYZ")
    link(upper, parts.inputs[0])
    brightest = parts.outputs[0]
    for part in parts.outputs[1:]:
        larger = node("ShaderNodeMath")
        larger.operation = "MAXIMUM"
        link(brightest, larger.inputs[0])
        link(part, larger.inputs[1])
        brightest = larger.outputs[0]
    luminance = node("ShaderNodeRGBToBW")
    link(upper, luminance.inputs[0])
    grey = mixed("MIX", 0.5, luminance.outputs[0], brightest)
    underside = mixed("MIX", 0.45, upper, grey)
    reflected = mixed("MIX", node("ShaderNodeNewGeometry").outputs["Backfacing"], upper, underside)
    # T = 0.55 R sqrt(R / max R)
    warm = node("ShaderNodeGamma")
    link(mixed("DIVIDE", 1.0, upper, brightest), warm.inputs[0])
    warm.inputs[1].default_value = 0.5
    passed = mixed("MULTIPLY", 1.0, mixed("MULTIPLY", 1.0, upper, warm.outputs[0]), 0.55)

    surface, through = node("ShaderNodeBsdfPrincipled"), node("ShaderNodeBsdfTranslucent")
    surface.inputs["Roughness"].default_value = 0.6
    link(reflected, surface.inputs["Base Color"])
    link(passed, through.inputs["Color"])
    if relief:
        bumps = node("ShaderNodeNormalMap")
        link(picture(load_image(relief, f"{name} relief", False)), bumps.inputs["Color"])
        link(bumps.outputs[0], surface.inputs["Normal"])
    both = node("ShaderNodeAddShader")
    link(surface.outputs[0], both.inputs[0])
    link(through.outputs[0], both.inputs[1])
    link(both.outputs[0], node("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def import_leaf(context, path, fps=24):
    """Builds the leaf of a GLB of wilt in a collection of its own and sets the scene's frames; returns its objects."""
    glb = Glb(path)
    name = os.path.splitext(os.path.basename(path))[0]
    scene = context.scene
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    scene_frames = [1.0 + fps * time for time in glb.times()]
    scene.render.fps, scene.render.fps_base = fps, 1.0
    scene.frame_start, scene.frame_end = 1, max(1, math.ceil(scene_frames[-1] - 1e-3))
    built = []
    for source in glb.json["meshes"]:
        leaf, colours = build_object(glb, source, collection)
        # A leaf that came from a file in other units is shown in metres.
        leaf.scale = [glb.json["asset"]["extras"]["wilt"]["metres_per_unit"]] * 3
        look = glb.json["materials"][source["primitives"][0]["material"]]
        texture = look["pbrMetallicRoughness"].get("baseColorTexture")
        material = build_material(source["name"], glb.image(texture), glb.image(look.get("normalTexture")))
        leaf.data.materials.append(material)
        if leaf.data.shape_keys:
            animate_shapes(leaf.data.shape_keys, scene_frames)
        if 1 < len(colours) and len(colours) * len(colours[0]) <= MOST_SAMPLES:
            store = colour_store(source["name"], colours)
            modifier = leaf.modifiers.new("wilt ageing", "NODES")
            modifier.node_group = ageing_tree(source["name"], store, len(colours[0]), scene_frames)
        elif len(colours) > 1:
            print("wilt: too many colours for nodes; the leaf has those of its last frame throughout")
        built.append(leaf)
    scene.frame_set(scene.frame_start)
    return built


# --- the menu -------------------------------------------------------------------------------------------------


class ImportWiltLeaf(bpy.types.Operator):
    """A withering leaf with its shapes, ageing colours and material"""

    bl_idname = "import_scene.wilt"
    bl_label = "Import wilt result"
    bl_options = {"UNDO"}
    filepath: bpy.props.StringProperty(subtype="FILE_PATH")
    filter_glob: bpy.props.StringProperty(default="*.glb", options={"HIDDEN"})
    fps: bpy.props.IntProperty(name="Frames per second", default=24, min=1, max=240)

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            import_leaf(context, self.filepath, self.fps)
        except (OSError, ValueError, KeyError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def menu(self, context):
    self.layout.operator(ImportWiltLeaf.bl_idname, text="wilt result (.glb)")


def register():
    bpy.utils.register_class(ImportWiltLeaf)
    bpy.types.TOPBAR_MT_file_import.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(menu)
    bpy.utils.unregister_class(ImportWiltLeaf)


# --- without a window -----------------------------------------------------------------------------------------


def world_points(context, leaves):
    """All vertices as they are shown at the current frame, #V x 3."""
    graph = context.evaluated_depsgraph_get()
    parts = []
    for leaf in leaves:
        shown = leaf.evaluated_get(graph).data
        points = np.empty(3 * len(shown.vertices), np.float32)
        shown.vertices.foreach_get("co", points)
        parts.append(points.reshape(-1, 3) * np.array(leaf.scale, np.float32))
    return np.concatenate(parts)


def add_stage(context, leaves):
    """A table, a sun, a sky and a camera that sees the leaf from obliquely above."""
    scene = context.scene
    points = world_points(context, leaves)
    low, high = points.min(axis=0), points.max(axis=0)
    centre, size = (low + high) / 2, float(np.linalg.norm(high - low))
    bpy.ops.mesh.primitive_plane_add(size=40 * size, location=(centre[0], centre[1], low[2]))
    table = bpy.data.materials.new("table")
    table.use_nodes = True
    table.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.75, 0.73, 0.7, 1)
    context.object.data.materials.append(table)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle = 2.0, 0.03
    sun.rotation_euler = (math.radians(45), 0, math.radians(50))
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.8, 0.87, 1.0, 1)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.4
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.clip_start, camera.data.lens = size / 100, 60
    elevation = math.radians(50)
    camera.location = centre + 1.45 * size * np.array([0, -math.cos(elevation), math.sin(elevation)])
    camera.rotation_euler = (math.pi / 2 - elevation, 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera


def render(context, leaves, path, frame, width):
    scene = context.scene
    scene.frame_set(frame)
    add_stage(context, leaves)
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", 64
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = width, width * 3 // 4
    scene.render.filepath = os.path.abspath(path)
    bpy.ops.render.render(write_still=True)


def main(arguments):
    parser = argparse.ArgumentParser(prog="blender --background --python wilt_import.py --")
    parser.add_argument("file", help="a .glb that wilt wrote")
    parser.add_argument("--save", metavar="FILE.blend", help="save the scene")
    parser.add_argument("--render", metavar="FILE.png", help="a picture by Cycles, on a table")
    parser.add_argument("--frame", type=int, help="of the picture (the last one)")
    parser.add_argument("--width", type=int, default=960, help="of the picture, in pixels (960)")
    parser.add_argument("--fps", type=int, default=24, help="frames per second (24)")
    options = parser.parse_args(arguments)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    leaves = import_leaf(bpy.context, options.file, options.fps)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.save), compress=True)
    if options.render:
        last = bpy.context.scene.frame_end
        render(bpy.context, leaves, options.render, last if options.frame is None else options.frame, options.width)


if __name__ == "__main__":
    if bpy.app.background and "--" in sys.argv:
        try:
            main(sys.argv[sys.argv.index("--") + 1 :])
        except (OSError, ValueError) as error:
            sys.exit(f"wilt_import: {error}")
    else:
        register()
