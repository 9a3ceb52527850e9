// On a phone a tap on a figure opens it at a size at which its words can be read; it scrolls, and closes on a tap.
document.addEventListener("click", (event) => {
  const picture = event.target.closest("figure a.image-reference img");
  if (!picture || !window.matchMedia("(max-width: 40rem)").matches) return;
  event.preventDefault();
  const sheet = document.createElement("dialog");
  const large = picture.cloneNode();
  const close = document.createElement("button");
  sheet.className = "picture";
  large.style.width = `${picture.naturalWidth / 1.75}px`; // letters of nine points are then 13 pixels high
  close.textContent = "Close";
  sheet.append(close, large);
  sheet.addEventListener("click", () => sheet.close());
  sheet.addEventListener("close", () => sheet.remove());
  document.body.append(sheet);
  sheet.showModal();
});
