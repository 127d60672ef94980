# Guided direct light gives the same image as path tracing of two segments.
step(${pharos} render ${SOURCE}/example.yaml -o ${WORK}/render/path.exr
     --set integrator.type=path --set integrator.max_depth=2 --set budget.spp=256)
step(${pharos} compare ${WORK}/render/example.exr --reference ${WORK}/render/path.exr
     --max-relmse 0.05)
# An installed preset by its name.
step(${pharos} render ${SOURCE}/example.yaml -o ${WORK}/render/preset.exr
     --set integrator.guiding=ppg-improved)
