#ifndef snug_elasticity_element_h
#define snug_elasticity_element_h

#include <snug/elasticity/lagrange.h>
#include <snug/elasticity/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace snug
{
  namespace elasticity
  {
    /**
     * Isoparametric Lagrange element of degree p = 1 or 2 on a quadrilateral
     * or hexahedron: stiffness, loads and volume with exact derivatives with
     * respect to node positions. Plane strain in 2D, unit thickness.
     *
     * n = (p+1)^dim nodes in tensor-product order, first coordinate fastest;
     * unknown dim*a + c is component c of node a. X: positions, V: velocities
     * of the positions, u: displacements, n vectors each. (p+1)^dim Gauss
     * points: exact for volumes; the same rule is used for all terms. Outputs
     * are resized and must not alias inputs.
     *
     * Derivatives along V at each Gauss point, with grad V = sum_a V_a (x) g_a
     * and g_a = grad N_a:
     * g_a' = -(grad V)^T g_a, (det J)' = det J div V,
     * (grad u)' = -(grad u) (grad V).
     *
     * Nothing is checked here: a cell with quality() <= 0 gives meaningless or,
     * where det J = 0, infinite numbers.
     */
    template <int dim>
    class Element
    {
    public:
      using Nodes = std::vector<dealii::Tensor<1, dim>>;

      /// @p degree 1 or 2.
      explicit Element(unsigned int degree);

      /// n.
      unsigned int
      n_nodes() const;

      /// K (n*dim x n*dim, row by row), exactly symmetric. Units: stress times
      /// length^(dim-2).
      void
      stiffness(const Nodes         &X,
                const Material      &material,
                std::vector<double> &K) const;

      /// r = K(X) u.
      void
      internal_force(const Nodes    &X,
                     const Material &material,
                     const Nodes    &u,
                     Nodes          &r) const;

      /// r = K'(X; V) u, exact.
      void
      internal_force_derivative(const Nodes    &X,
                                const Nodes    &V,
                                const Material &material,
                                const Nodes    &u,
                                Nodes          &r) const;

      /// gradient_a += factor * d/dX_a (w' K(X) u): at each Gauss point
      /// dV E g_a with E = (sigma_u:grad w) I - (grad w)^T sigma_u
      /// - (grad u)^T sigma_w.
      void
      add_energy_gradient(const Nodes    &X,
                          const Material &material,
                          const Nodes    &u,
                          const Nodes    &w,
                          double          factor,
                          Nodes          &gradient) const;

      /// f_a = int N_a b dV for a constant body force b.
      void
      body_force(const Nodes                  &X,
                 const dealii::Tensor<1, dim> &b,
                 Nodes                        &f) const;

      /// f = derivative of body_force() along V, exact.
      void
      body_force_derivative(const Nodes                  &X,
                            const Nodes                  &V,
                            const dealii::Tensor<1, dim> &b,
                            Nodes                        &f) const;

      /// gradient_a += factor * d/dX_a (f(X) . u)
      void
      add_body_force_gradient(const Nodes                  &X,
                              const dealii::Tensor<1, dim> &b,
                              const Nodes                  &u,
                              double                        factor,
                              Nodes                        &gradient) const;

      /// int dV [length^dim], signed.
      double
      volume(const Nodes &X) const;

      /// gradient_a += factor * d volume / dX_a.
      void
      add_volume_gradient(const Nodes &X, double factor, Nodes &gradient) const;

      /// Cauchy stress at a point of the reference cube [0,1]^dim; in plane
      /// strain, @p out_of_plane receives sigma_zz; 0 in 3D.
      dealii::SymmetricTensor<2, dim>
      stress(const Nodes              &X,
             const Material           &material,
             const Nodes              &u,
             const dealii::Point<dim> &point,
             double                   &out_of_plane) const;

      /**
       * Quality of the cell: the smallest det J over Gauss points and nodes,
       * divided by the mean of |det J| over the cell. 1 for a parallelepiped,
       * <= 0 tangled, 0 for a cell without volume or with NaN positions.
       */
      double
      quality(const Nodes &X) const;

    private:
      unsigned int                    degree;
      std::vector<LagrangePoint<dim>> gauss;
      std::vector<LagrangePoint<dim>> nodes;
      /// dN_a / d xi_d of gauss, [point][d][a], a padded with zeros to a
      /// multiple of 4: the layout stiffness() vectorizes over.
      std::vector<double> reference_gradients;
    };
  } // namespace elasticity
} // namespace snug

#endif
