#ifndef snug_app_workshop_h
#define snug_app_workshop_h

#include <snug/app/build_model.h>
#include <snug/io/contact_output.h>
#include <snug/io/fields.h>
#include <snug/io/summary.h>
#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/one_sided.h>
#include <snug/shape/shapes.h>

#include <memory>

namespace snug
{
  namespace app
  {
    /// "3 contacts are weakly active: ..." for the log and the summary.
    std::string
    one_sided_warning(unsigned int weak_contacts);

    /**
     * What every task of a scene works with: mesh, tearing, shape basis,
     * state solver and the writers of results.
     */
    template <int dim>
    class Workshop
    {
    public:
      using Field = typename mesh::BodyMesh<dim>::Field;

      /// Collective. @throws InputError.
      Workshop(RunContext &context, const scene::Scene &scene);

      /// Node positions of a design.
      Field
      positions(const std::vector<double> &design) const;

      /// The state of a design. Collective. @throws SolveError.
      state::ContactState<dim>
      solve(const std::vector<double> &design, const qp::WarmStart &start);

      /// Gradients of responses at a state. Collective.
      sensitivity::Gradients<dim>
      gradients(const sensitivity::Responses<dim>     &responses,
                const state::ContactState<dim>        &state,
                const std::vector<double>             &design,
                const sensitivity::GradientParameters &parameters);

      /// One-sided derivatives of responses at a state. Collective.
      std::vector<sensitivity::OneSided>
      one_sided_gradients(const sensitivity::Responses<dim> &responses,
                          const state::ContactState<dim>    &state,
                          const std::vector<double>         &design);

      /// Add a state to the pictures, with its shape gradient (this rank's
      /// share) if there is one. Collective.
      void
      draw(double                          time,
           const state::ContactState<dim> &state,
           const std::optional<Field>     &shape_gradient);

      /// Print what was read. Collective.
      void
      print_header();

      /// Warn where the model is doubtful at a state: print a line, and keep
      /// it for the summary, once.
      void
      warn(const state::ContactState<dim> &state);

      /// The same for any lines.
      void
      warn(const std::vector<std::string> &lines);

      /// How far a design moved slave nodes off the points they are paired
      /// with, in faces. Collective.
      double
      drift(const std::vector<double> &design) const;

      /// Fill in program, mesh, work and times and write summary.json.
      /// Collective.
      void
      write_summary(io::Summary &summary);

      /// The optimized surface and the control points. Collective.
      void
      export_shape(const std::vector<double> &design);

      /// File @p name of the output directory.
      std::string
      path(const std::string &name) const;

      RunContext                              &context;
      const scene::Scene                      &scene;
      std::unique_ptr<mesh::BodyMesh<dim>>     mesh;
      mesh::Tearing                            tearing;
      std::unique_ptr<shape::Shapes<dim>>      basis;
      std::unique_ptr<state::StateSolver<dim>> solver;
      std::unique_ptr<response::Response<dim>> objective;

    private:
      std::vector<double>
      bound_widths() const;

      std::vector<std::string>                warnings;
      std::unique_ptr<io::FieldOutput<dim>>   fields;
      std::unique_ptr<io::ContactOutput<dim>> contact_output;
    };
  } // namespace app
} // namespace snug

#endif
