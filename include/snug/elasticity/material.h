#ifndef snug_elasticity_material_h
#define snug_elasticity_material_h

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::elasticity {
/// Isotropic linear elastic material for small strains.
struct Material
{
  double youngs_modulus = 1.;  ///< [force / length^2], > 0
  double poissons_ratio = 0.3; ///< in (-1, 0.5)
  double density        = 0.;  ///< [mass / length^3], for gravity
  double expansion      = 0.;  ///< thermal strain per temperature [1 / temperature]
  double yield_stress = 0.; ///< in tension, only compared with stresses [force / length^2]; 0: none

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;

  double lame_lambda() const
  {
    return youngs_modulus * poissons_ratio / ((1. + poissons_ratio) * (1. - 2. * poissons_ratio));
  }

  double lame_mu() const { return youngs_modulus / (2. * (1. + poissons_ratio)); }

  /// Return kappa = lambda + 2/3 mu.
  double bulk_modulus() const { return youngs_modulus / (3. * (1. - 2. * poissons_ratio)); }
};
} // namespace snug::elasticity

#endif
