#ifndef snug_mortar_integral_gradient_h
#define snug_mortar_integral_gradient_h

#include <snug/mortar/mortar_coupling.h>

namespace snug::mortar {
/// Gradient with respect to the nodes and offsets of a slave face and of its master faces.
template <int dim>
struct FaceGradient
{
  MortarFace<dim, double>              slave;
  std::vector<MortarFace<dim, double>> masters;
};

/// Apply the transpose of the derivative of integrate(). From the gradient of a scalar with respect
/// to the integrals, compute its gradient with respect to nodes and offsets.
template <int dim>
FaceGradient<dim> integrate_transpose(const SegmentQuadrature<dim>               &quadrature,
                                      const MortarFace<dim, double>              &slave,
                                      const std::vector<MortarFace<dim, double>> &masters,
                                      const FaceIntegrals<double>                &gradient);
} // namespace snug::mortar

#endif
