// hexwright bench-one: the evaluation of one model, as a process that `bench` can end.
#include <memory>
#include <new>

#include "hexwright/render/picture.h"

#include "bench/bench_options.h"
#include "bench/child_process.h"
#include "bench/results.h"
#include "commands.h"
#include "options.h"
#include "view_file.h"

namespace hexwright::cli {
namespace {

namespace fs = std::filesystem;

struct BenchOneCommand {
  std::string model, out, name, key;
  std::size_t memory = 0;
  int parent = 0;  ///< process to end with
  BenchOptions options;
};

/// Draws what a record has and the folder has not yet.
class Illustrator {
 public:
  Illustrator(const BenchOneCommand& cmd, const TriMesh& surface) : cmd_(cmd), surface_(surface) {}

  void draw(const ModelRecord& record) {
    if (cmd_.options.no_pictures) return;
    draw_grid("input", record.input);
    for (int m = 0; m < kNumMethods; ++m)
      draw_grid(evaluated_methods()[m].key, record.methods[m].grid);
    if (record.mesh && record.mesh->mesh.num_hexes() > 0) {
      PictureOptions view = make_default_view(record.mesh->mesh);
      draw("mesh", record.mesh->mesh, view);
      view.cut.reset();
      draw("surface", record.mesh->mesh, view);
      write_page(*record.mesh);
    }
  }

  const Json& drawn() const { return drawn_; }
  const Json& page() const { return page_; }  ///< null before there is one

 private:
  /// All grids of a model are cut alike, in the middle; deeper cells are warmer.
  void draw_grid(const std::string& part, const Grid& grid) {
    if (grid.num_cells() == 0 || drawn_.contains(part)) return;
    const HexMesh mesh = leaves_as_hexes(grid);
    PictureOptions view = make_cut_view(1, 0.5);
    view.fade_boundary = false;  // faces where levels meet would count as boundary
    for (const GridCell& cell : grid.cells) view.values.push_back(1.0 - 0.1 * cell.level);
    draw(part, mesh, view);
  }

  void draw(const std::string& part, const HexMesh& mesh, PictureOptions view) {
    if (drawn_.contains(part)) return;
    view.width = cmd_.options.picture_width;
    view.height = view.width * 5 / 6;
    view.draw_legend = false;
    const fs::path file = picture_file(cmd_.out, cmd_.name, part);
    fs::create_directories(file.parent_path());
    write_png(file, render_hex_mesh(mesh, view));
    drawn_[part] = fs::relative(file, cmd_.out).generic_string();
  }

  void write_page(const MeshResult& result) {
    if (!page_.is_null()) return;
    const fs::path file = page_file(cmd_.out, cmd_.name);
    fs::create_directories(file.parent_path());
    write_view(file.string(), result, surface_, cmd_.name);
    page_ = fs::relative(file, cmd_.out).generic_string();
  }

  const BenchOneCommand& cmd_;
  const TriMesh& surface_;
  Json page_;
  Json drawn_ = Json::object();
};

void run(BenchOneCommand& cmd, Program& program) {
  end_with_parent(cmd.parent);
  limit_own_memory(cmd.memory);
  EvaluateOptions& options = cmd.options.evaluate;

  Json head = {{"schema", 1}, {"model", cmd.name}, {"key", cmd.key}, {"status", kRunning}};
  const auto give_up = [&](const char* status, const std::string& message) {
    head["status"] = status;
    head["message"] = message;
    save_record(cmd.out, cmd.name, head);
  };
  save_record(cmd.out, cmd.name, head);
  try {
    Context context = program.console.start();
    const TriMesh surface = read_surface(cmd.model).mesh;
    Illustrator illustrator(cmd, surface);
    const auto save = [&](const ModelRecord& record) {
      illustrator.draw(record);
      Json json = head;
      json.update(Json::parse(record_to_json(record)));
      json["pictures"] = illustrator.drawn();
      if (!illustrator.page().is_null()) json["page"] = illustrator.page();
      save_record(cmd.out, cmd.name, json);
    };
    const ModelRecord record = evaluate_model(surface, options, context, save);
    head["status"] = "done";
    save(record);
  } catch (const Error& e) {
    if (e.code() == ErrorCode::Cancelled) throw;
    give_up("failed", e.what());
  } catch (const std::bad_alloc&) {
    give_up("memory", "not enough memory");
  }
}

}  // namespace

void add_bench_one_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<BenchOneCommand>();
  CLI::App* sub = app.add_subcommand("bench-one", "One model of 'bench'");
  sub->group("");  // not for people
  sub->add_option("model", cmd->model)->required();
  sub->add_option("--out", cmd->out)->required();
  sub->add_option("--name", cmd->name)->required();
  sub->add_option("--key", cmd->key)->required();
  sub->add_option("--memory", cmd->memory);
  sub->add_option("--parent", cmd->parent);
  add_bench_options(*sub, cmd->options);
  add_console_options(*sub, program);
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
