# The guided image is the image of path tracing with light sampling. Its relMSE is 0.11 (seeds 1 and
# 2); without the guide it would be 0.21 to 0.24.
step(${pharos} render ${SOURCE}/example.yaml -o ${WORK}/render/reference.exr
     --set integrator.next_event_estimation=true --set integrator.guiding=null --set budget.spp=1024)
step(${pharos} compare ${WORK}/render/example.exr --reference ${WORK}/render/reference.exr
     --max-relmse 0.16)
