"""Runs within Blender: the scene of an experiment of this folder in Cycles, rendered; see cycles.py.

blender -b --python in_blender.py -- EXPERIMENT.json PICTURE.png THREADS RUNS
"""

import json
import math
import sys
import time
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

experiment, picture, threads, runs = sys.argv[sys.argv.index("--") + 1 :]
data = json.loads(Path(experiment).read_text())
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def material(name, build):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(build(tree), out.inputs["Surface"])
    return made


def glass(tree):
    node = tree.nodes.new("ShaderNodeBsdfGlass")
    node.distribution = "SHARP"
    node.inputs["Color"].default_value = (1, 1, 1, 1)
    node.inputs["IOR"].default_value = data["index"]
    return node.outputs["BSDF"]


def glow(tree):
    place, checker = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeTexChecker")
    shift = tree.nodes.new("ShaderNodeVectorMath")
    shift.inputs[1].default_value = (0, 0, -0.01)  # between two cubes the one below is shown
    emit = tree.nodes.new("ShaderNodeEmission")
    checker.inputs["Scale"].default_value = 1 / data["checker"]
    checker.inputs["Color2"].default_value = (*data["floor"][0], 1)
    checker.inputs["Color1"].default_value = (*data["floor"][1], 1)
    tree.links.new(place.outputs["Object"], shift.inputs[0])
    tree.links.new(shift.outputs[0], checker.inputs["Vector"])
    tree.links.new(checker.outputs["Color"], emit.inputs["Color"])
    return emit.outputs["Emission"]


def mesh(name, places, triangles, look, normals=None):
    made = bpy.data.meshes.new(name)
    made.from_pydata(places, [], triangles)
    made.materials.append(look)
    made.polygons.foreach_set("use_smooth", [normals is not None] * len(triangles))
    if normals is not None:
        made.use_auto_smooth = True
        made.normals_split_custom_set_from_vertices(normals)
    thing = bpy.data.objects.new(name, made)
    scene.collection.objects.link(thing)
    return thing


half = data["floor_size"] / 2
floor = mesh("floor", [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [(0, 1, 2, 3)], material("floor", glow))
floor.rotation_euler = (-math.pi / 2, 0, 0)
mesh("scan", data["places"], data["triangles"], material("glass", glass), data["normals"])

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
at, forward = Vector(data["at"]), (Vector(data["look_at"]) - Vector(data["at"])).normalized()
right = forward.cross(Vector((0, 1, 0))).normalized()
camera.matrix_world = Matrix.Translation(at) @ Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()
camera.data.sensor_fit = "VERTICAL"
camera.data.angle = math.radians(data["fov"])
camera.data.clip_start, camera.data.clip_end = 1, 1e5

world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
world.node_tree.nodes["Background"].inputs["Color"].default_value = (*data["background"], 1)

scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", data["samples"], False, False
cycles.max_bounces = cycles.transmission_bounces = cycles.glossy_bounces = data["depth"]
cycles.transparent_max_bounces, cycles.blur_glossy, cycles.pixel_filter_type = data["depth"], 0, "BOX"
cycles.sample_clamp_indirect = cycles.sample_clamp_direct = 0
cycles.caustics_reflective = cycles.caustics_refractive = True
cycles.min_light_bounces = cycles.min_transparent_bounces = data["depth"]  # no path is ended by chance
scene.render.threads_mode, scene.render.threads = "FIXED", int(threads)
scene.render.resolution_x, scene.render.resolution_y = data["resolution"]
scene.render.use_persistent_data = True  # the second picture finds its tree built
scene.view_settings.view_transform = "Standard"
scene.render.image_settings.file_format = "PNG"
scene.render.dither_intensity = 0
scene.render.filepath = picture
for run in range(int(runs) + 1):  # the first builds the tree, and is not timed
    start = time.time()
    bpy.ops.render.render(write_still=run == 0)
    print("CYCLES", run, time.time() - start, flush=True)
