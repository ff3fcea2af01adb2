#ifndef snug_elasticity_element_h
#define snug_elasticity_element_h

#include <snug/elasticity/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace snug
{
  namespace elasticity
  {
    /**
     * Isoparametric Lagrange element of degree p on a quadrilateral or
     * hexahedron: stiffness, loads and volume with exact derivatives with
     * respect to node positions. Plane strain in 2D.
     *
     * n = (p+1)^dim nodes in tensor-product order, first coordinate fastest;
     * unknown dim*a + c is component c of node a. X: positions, V: velocities
     * of the positions, u: displacements, all n x dim. (p+1)^dim Gauss points.
     *
     * Derivatives along V at each Gauss point:
     * (grad N_a)' = -(grad V)' grad N_a, (det J)' = det J div V.
     */
    template <int dim>
    class Element
    {
    public:
      using Nodes = std::vector<dealii::Tensor<1, dim>>;

      explicit Element(unsigned int degree);

      unsigned int
      n_nodes() const;

      /// K (n*dim x n*dim, row by row). Units: force / length.
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

      /// gradient_a += factor * d/dX_a (w' K(X) u).
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

      double
      volume(const Nodes &X) const;
      /// gradient_a += factor * d volume / dX_a.
      void
      add_volume_gradient(const Nodes &X, double factor, Nodes &gradient) const;

      /// Cauchy stress at a point of the reference cube [0,1]^dim; in plane
      /// strain, @p out_of_plane receives sigma_zz.
      dealii::SymmetricTensor<2, dim>
      stress(const Nodes              &X,
             const Material           &material,
             const Nodes              &u,
             const dealii::Point<dim> &point,
             double                   &out_of_plane) const;

      /**
       * Quality of the cell: the smallest det J over Gauss points and nodes,
       * divided by the mean of |det J|. 1 for a parallelepiped, <= 0 tangled.
       */
      double
      quality(const Nodes &X) const;

    private:
      struct Shape
      {
        std::vector<double>                 values;    ///< n
        std::vector<dealii::Tensor<1, dim>> gradients; ///< n, reference
        double                              weight;
      };

      Shape
      shape(const dealii::Point<dim> &point) const;

      unsigned int        degree;
      std::vector<Shape>  gauss;
      std::vector<Shape>  nodes;
    };

    /**
     * Dead surface loads of one oriented boundary face (see BodyMesh::Face)
     * with (p+1)^(dim-1) nodes: f_a = int N_a (t dA - q n dA), traction t,
     * pressure q along the inner normal of the design.
     */
    template <int dim>
    class FaceLoad
    {
    public:
      using Nodes = std::vector<dealii::Tensor<1, dim>>;

      explicit FaceLoad(unsigned int degree);

      void
      force(const Nodes                  &X,
            double                        pressure,
            const dealii::Tensor<1, dim> &traction,
            Nodes                        &f) const;
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

      /// Tributary areas int N_a dA.
      std::vector<double>
      areas(const Nodes &X) const;

    private:
      struct Shape
      {
        std::vector<double>                     values;
        std::vector<dealii::Tensor<1, dim - 1>> gradients;
        double                                  weight;
      };
      std::vector<Shape> gauss;
    };
  } // namespace elasticity
} // namespace snug

#endif
