#ifndef snug_elasticity_face_load_h
#define snug_elasticity_face_load_h

#include <snug/elasticity/lagrange.h>
#include <snug/mesh/idealization.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace snug
{
  namespace elasticity
  {
    /**
     * Dead surface loads of one oriented boundary face (see BodyMesh::Face)
     * with n = (p+1)^(dim-1) nodes, degree p = 1 or 2:
     * f_a = int N_a (t dA - q n dA), traction t [force / length^2],
     * pressure q along the inner normal -n of the given positions.
     *
     * With tangents t_i = dx/d xi_i, n dA = w m d xi, m = t_1 x t_2 in 3D,
     * (t_y, -t_x) in 2D, and the weight w of the idealization. Derivatives
     * along node velocities V: m' = V_,1 x t_2 + t_1 x V_,2,
     * dA' = (w n.m' + w' |m|) d xi and w' = dw/dx . V.
     *
     * X: positions, V: velocities of the positions, u: displacements, n
     * vectors each. (p+1)^(dim-1) Gauss points. |m| > 0 is assumed.
     */
    template <int dim>
    class FaceLoad
    {
    public:
      using Nodes = std::vector<dealii::Tensor<1, dim>>;

      explicit FaceLoad(unsigned int              degree,
                        const mesh::Idealization &idealization =
                          mesh::Idealization::natural(dim));

      /// f_a [force].
      void
      force(const Nodes                  &X,
            double                        pressure,
            const dealii::Tensor<1, dim> &traction,
            Nodes                        &f) const;

      /// f = derivative of force() along V, exact.
      void
      force_derivative(const Nodes                  &X,
                       const Nodes                  &V,
                       double                        pressure,
                       const dealii::Tensor<1, dim> &traction,
                       Nodes                        &f) const;

      /// gradient_a += factor * d/dX_a (f(X) . u)
      void
      add_force_gradient(const Nodes                  &X,
                         double                        pressure,
                         const dealii::Tensor<1, dim> &traction,
                         const Nodes                  &u,
                         double                        factor,
                         Nodes                        &gradient) const;

      /// Tributary areas int N_a dA [length^2].
      std::vector<double>
      areas(const Nodes &X) const;

    private:
      mesh::Idealization                  idealization;
      std::vector<LagrangePoint<dim - 1>> gauss;
    };
  } // namespace elasticity
} // namespace snug

#endif
