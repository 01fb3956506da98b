# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

janus = bpy.context.scene.janus

janus.samples = 4096
janus.use_adaptive_sampling = True
janus.adaptive_threshold = 0.01
janus.adaptive_min_samples = 0
janus.time_limit = 0.0
janus.use_denoising = True
janus.denoising_input_passes = "RGB_ALBEDO_NORMAL"
janus.denoising_prefilter = "ACCURATE"
janus.denoising_quality = "HIGH"
