# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

janus = bpy.context.scene.janus

janus.preview_samples = 4096
janus.use_preview_adaptive_sampling = True
janus.preview_adaptive_threshold = 0.01
janus.preview_adaptive_min_samples = 0
janus.use_preview_denoising = True
janus.preview_denoising_start_sample = 1
janus.preview_denoising_input_passes = "RGB_ALBEDO_NORMAL"
janus.preview_denoising_prefilter = "ACCURATE"
janus.preview_denoising_quality = "HIGH"
