// The guided methods that the suite of unbiased images compares with unguided renders.
#pragma once

#include <string>
#include <vector>

namespace pharos::testing {

/// A guiding method: settings of the integrator's `guiding`, and further settings of the config. A
/// setting of `guiding` begins with the separator that follows `integrator.guiding`,
/// "." if it has none.
struct Method {
  std::string name;
  std::vector<std::string> settings;
  std::vector<std::string> others = {};
};

/// Focal guiding.
Method focal(float unguided_fraction, const char* extent, const char* images);

/// The variants of vertex triplets.
enum class Triplets { pairs, plain, light_training, light_always };
Method triplets(Triplets variant, const char* surfaces, float unguided_fraction, bool guide_camera,
                const char* images);

/// Returns a pairwise covering array of unguided fractions, extents of splats and uses of
/// training images, and in addition learned fractions.
std::vector<Method> focal_methods();
/// Returns a covering array of guiders, unguided fractions, trees or single mixtures, and uses of
/// training images.
std::vector<Method> gaussian_methods();
/// Returns a covering array of targets, mixing policies, filters, and uses of training images.
std::vector<Method> sd_tree_methods();
/// Returns a covering array of mixtures, products, mixing policies, and uses of training images.
std::vector<Method> lobe_methods();
/// Returns one half of a pairwise covering array of variants, surface techniques, unguided
/// fractions, guides of first vertices, and uses of training images.
std::vector<Method> triplet_methods(int half);
/// Returns every kind of guide that leaves distances to the media.
std::vector<Method> media_methods();
/// Returns mixtures of one, two and three methods, with shares near their bounds and with methods
/// that are left out where they are not worth their cost. Triplets steer discrete events.
std::vector<Method> simplex_methods();
/// Returns methods that choose steps among candidates, with fixed and with learned shares.
std::vector<Method> resampled_methods();
/// Returns a method without any knowledge of light whose final image has more samples where the
/// training images were noisy: with paths from the sensor, and with paths from both ends.
std::vector<Method> adaptive_methods();
/// Returns the preset `robust` as it is, and with trainings whose ends depend on what they found.
std::vector<Method> robust_methods();
/// Returns every termination with focal guiding, an SD-tree, parallax-aware mixtures and the preset
/// `robust`, and, first of all, those that end or split paths without guides.
std::vector<Method> termination_methods();

}  // namespace pharos::testing
