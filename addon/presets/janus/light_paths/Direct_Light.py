# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

janus = bpy.context.scene.janus

janus.max_bounces = 0
janus.diffuse_bounces = 0
janus.glossy_bounces = 0
janus.transmission_bounces = 0
janus.transparent_max_bounces = 8
janus.sample_clamp_direct = 0.0
janus.sample_clamp_indirect = 0.0
