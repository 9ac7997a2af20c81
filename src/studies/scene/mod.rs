//! `plane-contact scene`.

pub mod benchmark;
mod copy;
mod export;
mod list;
mod mesh;
mod new;
mod plan;
mod schema;

commands::group! {
    /// List, copy, begin, mesh, plan, or export a scene, or print the schema of scene files.
    #[command(after_help = "\
Examples:
  plane-contact scene list
  plane-contact scene copy fig1 --out my
  plane-contact scene new my/block.msh
  plane-contact scene mesh hertz --size 40 --out hertz
  plane-contact scene plan strand
  plane-contact scene export strand --out strand.inp")]
    Command {
        List(list::Args): list::run,
        Copy(copy::Args): copy::run,
        New(new::Args): new::run,
        Mesh(mesh::Args): mesh::run,
        Plan(plan::Args): plan::run,
        Export(export::Args): export::run,
        Schema(schema::Args): schema::run,
    }
}
